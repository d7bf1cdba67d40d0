package io.furrow.mission.mongo;

import java.util.HexFormat;

/**
 * Encodes JSON names as field names of a document, so that every name can be stored, queried and decoded: {@code %25}
 * for a percent sign, {@code %2E} for a dot (MongoDB reads it as a path), {@code %24} for a leading dollar sign
 * (MongoDB reads it as an operator), {@code %00} for a null byte (it ends a name in BSON), {@code %5F} for a leading
 * underscore at the top of a document (Furrow's own fields begin with it), {@code %} alone for the empty name. Other
 * names are not changed.
 */
final class FieldName {
    private static final String EMPTY = "%";

    private FieldName() {}

    /** Encodes the name of an attribute, at the top of a document. */
    static String ofAttribute(String name) {
        return name.startsWith("_") ? "%5F" + of(name.substring(1), false) : of(name);
    }

    /** Encodes a name at a lower level. */
    static String of(String name) {
        return name.isEmpty() ? EMPTY : of(name, true);
    }

    private static String of(String name, boolean leads) {
        StringBuilder encoded = null;
        for (int i = 0; i < name.length(); i++) {
            char c = name.charAt(i);
            boolean special = c == '%' || c == '.' || c == 0 || c == '$' && i == 0 && leads;
            if (special && encoded == null) {
                encoded = new StringBuilder(name.length() + 8).append(name, 0, i);
            }
            if (special) {
                encoded.append('%').append(HexFormat.of().withUpperCase().toHexDigits((byte) c));
            } else if (encoded != null) {
                encoded.append(c);
            }
        }
        return encoded == null ? name : encoded.toString();
    }

    /** Decodes a field name. */
    static String decode(String field) {
        if (field.indexOf('%') < 0) {
            return field;
        }
        StringBuilder name = new StringBuilder(field.length());
        for (int i = 0; i < field.length(); i++) {
            char c = field.charAt(i);
            if (c == '%' && i + 2 < field.length() && isHex(field, i + 1)) {
                name.append((char) HexFormat.fromHexDigits(field, i + 1, i + 3));
                i += 2;
            } else if (c != '%' || field.length() > 1) {
                name.append(c); // a percent sign of a document that Furrow did not write
            }
        }
        return name.toString();
    }

    private static boolean isHex(String field, int at) {
        return HexFormat.isHexDigit(field.charAt(at)) && HexFormat.isHexDigit(field.charAt(at + 1));
    }
}
