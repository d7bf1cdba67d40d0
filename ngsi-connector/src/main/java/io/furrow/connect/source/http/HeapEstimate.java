package io.furrow.connect.source.http;

import io.furrow.connect.source.option.OverloadOptions;

/**
 * Estimates the heap in bytes that a notification needs while it is translated and made durable: its bytes as text, as
 * a tree, as records and in the journal's format. Short JSON can be a large tree: {@code {},} has 3 bytes there and
 * more than 100 here. The estimate errs on the high side.
 */
final class HeapEstimate {
    /** Per value or name in the tree, with its share of the enclosing collection. */
    private static final int PER_NODE = 96;
    /** Per object that may be an entity, mostly for the headers of its record. */
    private static final int PER_ENTITY = 3072;
    /** Entities are elements of an array in an object, or in GeoJSON one object deeper. */
    private static final int DEEPEST_ENTITY = 3;

    private HeapEstimate() {}

    /** Counts the brackets, commas and colons outside of strings; invalid JSON gets an estimate as well. */
    static long of(byte[] json) {
        long nodes = 0;
        long entities = 0;
        int depth = 0;
        long arrays = 0; // whether what is open is an array, a bit each, the innermost last
        for (int i = 0; i < json.length; i++) {
            switch (json[i]) {
                case '"' -> i = endOfText(json, i);
                case ',', ':' -> nodes++;
                case '{' -> {
                    nodes++;
                    entities += depth <= DEEPEST_ENTITY ? arrays & 1 : 0;
                    depth++;
                    arrays <<= 1;
                }
                case '[' -> {
                    nodes++;
                    depth++;
                    arrays = arrays << 1 | 1;
                }
                case '}', ']' -> {
                    depth--;
                    arrays >>>= 1;
                }
                default -> {}
            }
        }
        return (entities + 1) * PER_ENTITY + nodes * PER_NODE + (long) json.length * OverloadOptions.HEAP_PER_BYTE;
    }

    /** The position of the closing quotation mark, or the end of the document if there is none. */
    private static int endOfText(byte[] json, int begin) {
        for (int i = begin + 1; i < json.length; i++) {
            if (json[i] == '"') {
                return i;
            }
            if (json[i] == '\\') {
                i++;
            }
        }
        return json.length;
    }
}
