package io.furrow.analytics.collision.matching;

import org.apache.flink.api.common.typeinfo.TypeInfo;

/**
 * Rules that counted, or count.
 *
 * @param until the last instant, epoch milliseconds, at which what had been before was judged by them; {@link #NOW} for those
 *     that count
 */
@TypeInfo(RulesUntilSerializer.class)
record RulesUntil(KnownRules rules, long until) {
    static final long NOW = Long.MAX_VALUE;
}
