package io.furrow.cli.compare;

import java.util.Comparator;

/**
 * The subject of a result.
 *
 * @param scope tenant and service path
 * @param types of its devices, because entities of several types may share an id; empty for a field
 * @param name for instance both devices of a pair, or a field and the averaged attribute
 */
record ResultSubject(String scope, String types, String name) implements Comparable<ResultSubject> {
    private static final Comparator<ResultSubject> ORDER = Comparator.comparing(ResultSubject::name)
            .thenComparing(ResultSubject::types)
            .thenComparing(ResultSubject::scope);

    /** The same without the scope, for results of a single tenant. */
    ResultSubject anyScope() {
        return new ResultSubject("", types, name);
    }

    @Override
    public int compareTo(ResultSubject other) {
        return ORDER.compare(this, other);
    }
}
