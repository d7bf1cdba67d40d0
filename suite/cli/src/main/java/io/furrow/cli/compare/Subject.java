package io.furrow.cli.compare;

/**
 * The subject of a result.
 *
 * @param scope tenant and service path
 * @param name for instance both devices of a pair, or a field and the attribute that was averaged
 */
record Subject(String scope, String name) implements Comparable<Subject> {
    /** The same whatever the tenant is, where there is only one. */
    Subject anyScope() {
        return new Subject("", name);
    }

    @Override
    public int compareTo(Subject other) {
        int byName = name.compareTo(other.name);
        return byName == 0 ? scope.compareTo(other.scope) : byName;
    }
}
