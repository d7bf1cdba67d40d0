package io.furrow.connect.subscription;

/**
 * The part of all entity ids of which one of several tasks is notified: the ids that end in certain letters and digits;
 * the last part also includes the ids that end in any other character. The parts are disjoint and cover every id, so
 * each entity has one task, which preserves its order.
 *
 * @param index from 0
 * @param count at most {@value #MAX}
 */
public record IdPartition(int index, int count) {
    /** There are no more letters and digits to divide. */
    public static final int MAX = 36;

    /** Every id. */
    public static final IdPartition ALL = new IdPartition(0, 1);

    /** Digits first: ids that end in numbers are spread evenly over up to ten parts. */
    private static final String SIGNS = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

    public IdPartition {
        if (count < 1 || count > MAX || index < 0 || index >= count) {
            throw new IllegalArgumentException("no part of ids: " + index + " of " + count);
        }
    }

    /** A regular expression, of POSIX and of Java, that is found in the ids of this part. */
    public String pattern() {
        if (count == 1) {
            return ".*";
        }
        return index < count - 1 ? "[" + signs(index) + "]$" : "[^" + signsOfTheOthers() + "]$";
    }

    /** {@code 2/3} for the second of three. */
    public String label() {
        return (index + 1) + "/" + count;
    }

    private String signs(int part) {
        StringBuilder signs = new StringBuilder();
        for (int i = part; i < SIGNS.length(); i += count) {
            signs.append(SIGNS.charAt(i));
        }
        return signs.toString();
    }

    private String signsOfTheOthers() {
        StringBuilder signs = new StringBuilder();
        for (int part = 0; part < count - 1; part++) {
            signs.append(signs(part));
        }
        return signs.toString();
    }
}
