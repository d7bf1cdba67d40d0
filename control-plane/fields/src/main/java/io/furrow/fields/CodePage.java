package io.furrow.fields;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.CharBuffer;
import java.nio.charset.Charset;
import java.nio.charset.CharsetDecoder;
import java.nio.charset.StandardCharsets;
import java.util.Map;
import java.util.Optional;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/** Finds the code page of the attribute table of a Shapefile, as GDAL does. */
final class CodePage {
    private static final Pattern UTF_8 = Pattern.compile("(?i)UTF[ _-]?8\\b.*");
    private static final Pattern ISO = Pattern.compile("(?i)(?:ISO)?[ _-]?8859[ _-]?(\\d{1,2})");
    private static final Pattern NUMBER = Pattern.compile("(?i)(?:ANSI|OEM|CP|IBM|MS|WINDOWS)?[ _-]*(\\d{3,5})");

    /** The language driver of a table, byte 29, and its code page. */
    private static final Map<Integer, Integer> DRIVERS = Stream.of(
                    ("1:437 2:850 3:1252 4:10000 8:865 9:437 10:850 11:437"
                                    + " 13:437 14:850 15:437 16:850 17:437 18:850 19:932 20:850 21:437 22:850 23:865 24:437 25:437"
                                    + " 26:850 27:437 28:863 29:850 31:852 34:852 35:852 36:860 37:850 38:866 55:850 64:852 77:936"
                                    + " 78:949 79:950 80:874 87:28591 88:1252 89:1252 100:852 101:866 102:865 103:861 106:737"
                                    + " 107:857 108:863 120:950 121:949 122:936 123:932 124:874 134:737 135:852 136:857 150:10007"
                                    + " 151:10029 152:10006 200:1250 201:1251 202:1254 203:1253 204:1257")
                            .split(" "))
            .map(pair -> pair.split(":"))
            .collect(Collectors.toMap(pair -> Integer.valueOf(pair[0]), pair -> Integer.valueOf(pair[1])));
    /** Charsets of code pages that Java names neither {@code IBM…} nor {@code windows-…}. */
    private static final Map<Integer, String> NAMES = Map.of(
            932, "windows-31j",
            936, "GBK",
            949, "x-windows-949",
            950, "x-windows-950",
            10000, "x-MacRoman",
            10006, "x-MacGreek",
            10007, "x-MacCyrillic",
            10029, "x-MacCentralEurope",
            20127, "US-ASCII",
            65001, "UTF-8");

    private static final int DRIVER = 29;
    private static final int DESCRIPTOR = 32;
    private static final int LATIN_1 = 28_591;
    private static final int FIRST_OF_ISO = 28_590;

    private CodePage() {}

    /** Parses the name of a code page as written in .cpg files: {@code UTF-8}, {@code 1252}, {@code OEM 850}, {@code 88591}. */
    static Optional<Charset> named(String name) {
        Matcher iso = ISO.matcher(name);
        if (UTF_8.matcher(name).matches()) {
            return Optional.of(StandardCharsets.UTF_8);
        } else if (iso.matches()) {
            return charset("ISO-8859-" + iso.group(1));
        }
        Matcher number = NUMBER.matcher(name);
        return number.matches() ? numbered(Integer.parseInt(number.group(1))) : charset(name);
    }

    private static Optional<Charset> numbered(int number) {
        if (NAMES.containsKey(number)) {
            return charset(NAMES.get(number));
        }
        return number > FIRST_OF_ISO && number <= FIRST_OF_ISO + 16
                ? charset("ISO-8859-" + (number - FIRST_OF_ISO))
                : charset("cp" + number);
    }

    private static Optional<Charset> charset(String name) {
        try {
            return Optional.of(Charset.forName(name));
        } catch (IllegalArgumentException e) {
            return Optional.empty();
        }
    }

    /** Returns the code page that the header of a table names; empty if it is missing or unknown. */
    static Optional<Charset> of(byte[] table) {
        return table.length <= DRIVER
                ? Optional.empty()
                : Optional.ofNullable(DRIVERS.get(table[DRIVER] & 0xff)).flatMap(CodePage::numbered);
    }

    /** Whether a table names Latin-1, Windows-1252 or no code page: programs write these as defaults, whatever the actual encoding. */
    static boolean isDefault(byte[] table) {
        int page = table.length <= DRIVER ? LATIN_1 : DRIVERS.getOrDefault(table[DRIVER] & 0xff, LATIN_1);
        return page == LATIN_1 || page == 1252;
    }

    /** Encoding of the text columns of a table. */
    enum Texts {
        ASCII,
        UTF_8,
        OTHER
    }

    static Texts textsOf(byte[] table) {
        ByteBuffer header = ByteBuffer.wrap(table).order(ByteOrder.LITTLE_ENDIAN);
        if (table.length < DESCRIPTOR) {
            return Texts.ASCII;
        }
        int records = header.getShort(8) & 0xffff;
        int length = header.getShort(10) & 0xffff;
        Texts all = Texts.ASCII;
        for (int row = records; length > 0 && row + length <= table.length; row += length) {
            int column = row + 1;
            for (int field = DESCRIPTOR; field + DESCRIPTOR <= records && table[field] != 0x0d; field += DESCRIPTOR) {
                int width = table[field + 16] & 0xff;
                if (table[field + 11] == 'C' && column + width <= table.length) {
                    Texts text = textOf(table, column, width);
                    all = text == Texts.ASCII ? all : text;
                }
                if (all == Texts.OTHER) {
                    return all;
                }
                column += width;
            }
        }
        return all;
    }

    /** A text may be truncated within a character at the end of its column. */
    private static Texts textOf(byte[] table, int from, int width) {
        boolean isAscii = true;
        for (int at = from; at < from + width; at++) {
            isAscii &= table[at] >= 0;
        }
        if (isAscii) {
            return Texts.ASCII;
        }
        CharsetDecoder decoder = StandardCharsets.UTF_8.newDecoder();
        return decoder.decode(ByteBuffer.wrap(table, from, width), CharBuffer.allocate(width), false)
                        .isError()
                ? Texts.OTHER
                : Texts.UTF_8;
    }
}
