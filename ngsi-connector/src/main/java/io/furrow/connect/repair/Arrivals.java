package io.furrow.connect.repair;

import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.Map;

/**
 * How many notifications of each own subscription arrived. Anybody can send any id: of those that are not known to be own, the
 * newest {@value #MOST_OTHERS} are counted, because one that was made just now may notify before its id is known. Not safe for
 * threads.
 */
final class Arrivals {
    private static final int MOST_OTHERS = 1000;
    private static final int LONGEST_ID = 128;

    private final Map<String, Long> own = new HashMap<>();
    private final Map<String, Long> others = new LinkedHashMap<>(16, 0.75f, true) {
        private static final long serialVersionUID = 1L;

        @Override
        protected boolean removeEldestEntry(Map.Entry<String, Long> eldest) {
            return size() > MOST_OTHERS;
        }
    };

    void add(String subscription, int count) {
        if (own.computeIfPresent(subscription, (id, before) -> before + count) == null
                && subscription.length() <= LONGEST_ID) {
            others.merge(subscription, (long) count, Long::sum);
        }
    }

    long of(String subscription) {
        return own.getOrDefault(subscription, others.getOrDefault(subscription, 0L));
    }

    /** One subscription is own instead of another, which may be empty. */
    void replace(String former, String subscription) {
        own.remove(former);
        Long before = others.remove(subscription);
        own.putIfAbsent(subscription, before == null ? 0 : before);
    }
}
