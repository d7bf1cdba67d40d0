package io.furrow.cli.compare;

/**
 * The subject of a result.
 *
 * @param scope tenant and service path
 * @param name for instance both devices of a pair, or a field and the averaged attribute
 */
record ResultSubject(String scope, String name) implements Comparable<ResultSubject> {
    /** The same without the scope, for results of a single tenant. */
    ResultSubject anyScope() {
        return new ResultSubject("", name);
    }

    @Override
    public int compareTo(ResultSubject other) {
        int byName = name.compareTo(other.name);
        return byName == 0 ? scope.compareTo(other.scope) : byName;
    }
}
