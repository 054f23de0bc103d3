// Makes std::filesystem::path take and give its texts in UTF-8. libstdc++ converts them by this facet, whose own
// functions ask the C library, and that knows no UTF-8 here; these replace them where the program is linked statically.
#include <codecvt>
#include <cwchar>
#include <locale>

namespace std {
namespace {

const codecvt_utf8_utf16<wchar_t>& utf8() {
    static const codecvt_utf8_utf16<wchar_t> facet;
    return facet;
}

}  // namespace

using Facet = codecvt<wchar_t, char, mbstate_t>;

codecvt_base::result Facet::do_out(state_type& state, const intern_type* from, const intern_type* from_end,
                                   const intern_type*& from_next, extern_type* to, extern_type* to_end,
                                   extern_type*& to_next) const {
    return utf8().out(state, from, from_end, from_next, to, to_end, to_next);
}
codecvt_base::result Facet::do_in(state_type& state, const extern_type* from, const extern_type* from_end,
                                  const extern_type*& from_next, intern_type* to, intern_type* to_end,
                                  intern_type*& to_next) const {
    return utf8().in(state, from, from_end, from_next, to, to_end, to_next);
}
int Facet::do_encoding() const noexcept { return 0; }  // characters differ in their numbers of bytes
int Facet::do_max_length() const noexcept { return 4; }
int Facet::do_length(state_type& state, const extern_type* from, const extern_type* end, size_t most) const {
    return utf8().length(state, from, end, most);
}

}  // namespace std
