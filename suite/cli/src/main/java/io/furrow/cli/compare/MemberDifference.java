package io.furrow.cli.compare;

/**
 * A member of a result that is not the same on both sides.
 *
 * @param member closest, start, end, mean, suspects or quality
 * @param a number, text, or set of texts; null if it has none
 * @param b likewise
 */
record MemberDifference(String member, Object a, Object b) {}
