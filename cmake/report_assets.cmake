# Run at build time with CSS, JS and OUTPUT: writes both files as C++ string constants. Bytes are written as hexadecimal
# numbers: raw string literals have a length limit in some compilers, and any delimiter could occur in the text.
function(as_array path name text_variable)
  file(READ ${path} hex HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
  string(REGEX REPLACE "(0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,)" "\\1\n" bytes "${bytes}")
  set(${text_variable}
    "inline constexpr unsigned char ${name}[] = {\n${bytes}0};\n" PARENT_SCOPE)
endfunction()
as_array(${CSS} kReportCss css)
as_array(${JS} kReportJs js)
file(WRITE ${OUTPUT} "#pragma once\n\nnamespace plenolab::detail {\n${css}\n${js}\n}\n")
