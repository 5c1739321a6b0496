# Embeds the material library in a source file: INPUT, OUTPUT.
file(READ ${INPUT} text)
file(WRITE ${OUTPUT} "namespace pulvis {\n\nextern const char* const material_library_text;\n\
const char* const material_library_text = R\"library(${text})library\";\n\n}  // namespace pulvis\n")
