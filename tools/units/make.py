#!/usr/bin/env python3
"""Writes the names of units that UDUNITS-2 knows as the table of src/text/unit_names.cpp: make.py > unit_names.cpp.

It needs the library and its database (Debian: libudunits2-0, libudunits2-data). It keeps only names of letters, and "%"."""

import ctypes
import glob
import re
import xml.etree.ElementTree as ElementTree

LIBRARY = ctypes.CDLL("libudunits2.so.0")
HEAD = """// tools/units/make.py generates this file from the database of UDUNITS-2, copyright 2008, 2009 University Corporation
// for Atmospheric Research. Its notice is:
//
// Access and use of this software shall impose the following obligations and understandings on the user. The user is
// granted the right, without any fee or cost, to use, copy, modify, alter, enhance and distribute this software, and
// any derivative works thereof, and its supporting documentation for any purpose whatsoever, provided that this
// entire notice appears in all copies of the software, derivative works and supporting documentation. Further, UCAR
// requests that the user credit UCAR/Unidata in any publications that result from the use of this software or in any
// product that includes this software, although this is not an obligation. The names UCAR and/or Unidata, however,
// may not be used in any advertising or publicity to endorse or promote any products or commercial entity unless
// specific written permission is obtained from UCAR/Unidata. The user also understands that UCAR/Unidata is not
// obligated to provide the user with any support, consulting, training or assistance of any kind with regard to the
// use, operation and performance of this software nor to provide the user with any updates, revisions, new versions
// or "bug fixes."
//
// THIS SOFTWARE IS PROVIDED BY UCAR/UNIDATA "AS IS" AND ANY EXPRESS OR IMPLIED WARRANTIES, INCLUDING, BUT NOT LIMITED
// TO, THE IMPLIED WARRANTIES OF MERCHANTABILITY AND FITNESS FOR A PARTICULAR PURPOSE ARE DISCLAIMED. IN NO EVENT
// SHALL UCAR/UNIDATA BE LIABLE FOR ANY SPECIAL, INDIRECT OR CONSEQUENTIAL DAMAGES OR ANY DAMAGES WHATSOEVER RESULTING
// FROM LOSS OF USE, DATA OR PROFITS, WHETHER IN AN ACTION OF CONTRACT, NEGLIGENCE OR OTHER TORTIOUS ACTION, ARISING
// OUT OF OR IN CONNECTION WITH THE ACCESS, USE OR PERFORMANCE OF THIS SOFTWARE.
#include "text/unit_names.hpp"

namespace slipfront::medium {
namespace {

// clang-format off"""


def function(name, result, *arguments):
    it = getattr(LIBRARY, name)
    it.restype, it.argtypes = result, list(arguments)
    return it


POINTER, TEXT = ctypes.c_void_p, ctypes.c_char_p
read = function("ut_read_xml", POINTER, TEXT)
parse = function("ut_parse", POINTER, POINTER, TEXT, ctypes.c_int)
by_name = function("ut_get_unit_by_name", POINTER, POINTER, TEXT)
by_symbol = function("ut_get_unit_by_symbol", POINTER, POINTER, TEXT)
text_of = function("ut_format", ctypes.c_int, POINTER, TEXT, ctypes.c_size_t, ctypes.c_uint)
converter = function("ut_get_converter", POINTER, POINTER, POINTER)
converted = function("cv_convert_double", ctypes.c_double, POINTER, ctypes.c_double)
function("ut_set_error_message_handler", POINTER, POINTER)(ctypes.cast(LIBRARY.ut_ignore, POINTER))
SYSTEM = read(None)


def words():
    """Possible names: those of the database, and their plurals."""
    for path in glob.glob("/usr/share/xml/udunits/udunits2-*.xml"):
        for element in ElementTree.parse(path).iter():
            if element.tag in ("singular", "plural", "symbol"):
                word = element.text.strip()
                yield from (word, word + "s", word + "es", word[:-1] + "ies")


def mechanical(unit):
    """(factor to SI, (power of metre, kilogram, second)). The factor is 0 if the unit has other base units, an offset or a logarithm."""
    buffer = ctypes.create_string_buffer(300)
    text_of(unit, buffer, len(buffer), 8)  # as a number and a product of the base units
    text = buffer.value.decode()
    powers = {"m": 0, "kg": 0, "s": 0, "rad": 0}
    for factor in re.findall(r"[^ .0-9][^ .]*", re.sub(r"^-?[0-9.e+-]+( |$)", "", text)):
        name, power = re.match(r"([^-0-9]+)(-?[0-9]+)?", factor).groups()
        powers[name] = int(power or 1)
    if len(powers) > 4:
        return 0.0, (0, 0, 0)
    si = ".".join(f"{name}{power}" for name, power in powers.items() if power) or "1"
    return converted(converter(unit, parse(SYSTEM, si.encode(), 0)), 1.0), tuple(powers[name] for name in ("m", "kg", "s"))


def rows(look_up, word_of):
    found = {}
    for word in set(words()):
        unit = look_up(SYSTEM, word.encode()) if re.fullmatch("[A-Za-z]+|%", word) else None
        if unit:
            found[word_of(word)] = mechanical(unit)
    for word, (factor, powers) in sorted(found.items()):
        yield f'    {{"{word}", {{{factor!r}, {{{", ".join(map(str, powers))}}}}}}},'


print(HEAD)
for name, look_up, word_of in (("names", by_name, str.lower), ("symbols", by_symbol, str)):
    print(f"constexpr NamedUnit {name}[] = {{", *rows(look_up, word_of), "};", sep="\n")
print("""// clang-format on

}  // namespace

const std::span<const NamedUnit> unit_names = names, unit_symbols = symbols;

}  // namespace slipfront::medium""")
