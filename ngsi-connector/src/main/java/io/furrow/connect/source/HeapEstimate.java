package io.furrow.connect.source;

/**
 * Estimates the bytes of heap that a notification takes at a time while it is translated and made durable: its bytes as text, as
 * a tree, as records and as the journal writes them. What is short as JSON can be long as a tree: {@code {},} has 3 bytes there and
 * more than 100 here. It errs on the side of too much.
 */
final class HeapEstimate {
    /** Of each byte: as text in the tree, in the record, in the buffers of both, and in the journal's form. */
    static final int PER_BYTE = 6;
    /** Of each value or name in the tree, with its share of the collection that holds it. */
    private static final int PER_NODE = 96;
    /** Of each object that may be an entity: the headers of its record, mostly. */
    private static final int PER_ENTITY = 3072;
    /** Entities stand in an array in an object in, with GeoJSON, one object more. */
    private static final int DEEPEST_ENTITY = 3;

    private HeapEstimate() {}

    /** Looks at the brackets, commas and colons outside texts; what is no JSON gets some estimate as well. */
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
        return (entities + 1) * PER_ENTITY + nodes * PER_NODE + (long) json.length * PER_BYTE;
    }

    /** Where the closing quotation mark is, or the end of all where there is none. */
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
