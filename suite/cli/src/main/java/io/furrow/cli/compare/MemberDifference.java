package io.furrow.cli.compare;

/**
 * A member of a result that differs between both sides.
 *
 * @param member closest, start, end, mean, suspects or quality
 * @param a number, text, or set of texts; null if absent
 * @param b likewise
 */
record MemberDifference(String member, Object a, Object b) {}
