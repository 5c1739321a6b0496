# Sources that parse the bytes of user files. A sanitizer build replaces only these in the library of another build
# (tests/asan), so each must be a separate object there.
set(readers drawings/chains drawings/dxf_outline drawings/svg_outline language/csv_table language/document
            language/document_guard language/override language/scene_text language/table_reader let/expression let/let
            let/tokens lever/mesh/gmsh_file lever/mesh/gmsh_solid lever/mesh/meshed_lever lever/mesh/meshed_tip
            lever/target_shape outlines/points_file packing/packing_file packing/packing_table space/packing/packing_file tools/profile_file)
list(TRANSFORM readers REPLACE "(.+)" "scenes/\\1.cpp")
set(record_readers cli/laboratory/lab_record.cpp cli/laboratory/wedge_records.cpp cli/laboratory/volts/volts_records.cpp)
