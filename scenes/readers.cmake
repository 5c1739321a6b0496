# What takes the bytes of a user's file apart. A build with sanitizers replaces these alone in the library of another
# (tests/asan), so each is an object of its own there.
set(readers drawings/chains drawings/dxf_outline drawings/svg_outline language/csv_table language/document
            language/document_guard language/override language/scene_text language/table_reader let/expression let/let
            let/tokens lever/mesh/gmsh_file lever/mesh/gmsh_solid lever/mesh/meshed_lever lever/mesh/meshed_tip
            lever/target_shape outlines/points_file packing/packing_file packing/packing_table space/packing/packing_file records/lab_record records/wedge_records
            tools/profile_file volts/volts_records)
list(TRANSFORM readers REPLACE "(.+)" "scenes/\\1.cpp")
