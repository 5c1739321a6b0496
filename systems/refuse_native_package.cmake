message(FATAL_ERROR "The core library is built for this processor alone: no package for others. Configure with "
                    "-DPULVIS_INSTRUCTION_SETS=all and build first.")
