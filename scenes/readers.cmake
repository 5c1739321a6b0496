# Sources that parse the bytes of user files. A sanitizer build replaces only these in the library of another build
# (tests/asan), so each must be a separate object there.
set(readers drawings/chains drawings/dxf_outline drawings/svg_outline language/csv_table language/document
            language/document_guard language/override language/scene_text language/table_reader let/expression let/let
            let/tokens lever/mesh/gmsh_file lever/mesh/gmsh_solid lever/mesh/meshed_lever lever/mesh/meshed_tip
            lever/target_shape outlines/points_file packing/packing_file packing/packing_table space/packing/packing_file records/lab_record records/wedge_records
            tools/profile_file volts/volts_records)
list(TRANSFORM readers REPLACE "(.+)" "scenes/\\1.cpp")
