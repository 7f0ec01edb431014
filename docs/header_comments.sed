# For Doxygen: the first comment of a header is the file's, and `//` is read as `///`; after code it is that of the code
# before it, continued in lines that begin far to the right.
1s,^//+ ,/// \\file\n/// ,
s,^( {10\,})//+ ,\1///< ,
s,^( *)//( |$),\1///\2,
s,([;\,{}0-9a-z)]) +// ,\1 ///< ,
# What it cannot read: the specialization of std::hash.
/^template <>$/,/^};$/d
# A private struct has no page, but is linked from the page of its class.
/^  struct BodyBounds \{$/,/^  \};$/d
