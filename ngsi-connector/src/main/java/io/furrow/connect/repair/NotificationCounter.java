package io.furrow.connect.repair;

import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.Map;

/**
 * Counts the arrived notifications of each own subscription. Any sender can send any id: of unknown ids the newest
 * {@value #MAX_OTHERS} are counted, because a subscription that was just created may notify before its id is known. Not
 * thread-safe.
 */
final class NotificationCounter {
    private static final int MAX_OTHERS = 1000;
    private static final int MAX_ID_LENGTH = 128;

    private final Map<String, Long> own = new HashMap<>();
    private final Map<String, Long> others = new LinkedHashMap<>(16, 0.75f, true) {
        private static final long serialVersionUID = 1L;

        @Override
        protected boolean removeEldestEntry(Map.Entry<String, Long> eldest) {
            return size() > MAX_OTHERS;
        }
    };

    void add(String subscription, int count) {
        if (own.computeIfPresent(subscription, (id, before) -> before + count) == null
                && subscription.length() <= MAX_ID_LENGTH) {
            others.merge(subscription, (long) count, Long::sum);
        }
    }

    long of(String subscription) {
        return own.getOrDefault(subscription, others.getOrDefault(subscription, 0L));
    }

    /** A subscription replaces another one, which may be empty. */
    void replace(String former, String subscription) {
        own.remove(former);
        Long before = others.remove(subscription);
        own.putIfAbsent(subscription, before == null ? 0 : before);
    }
}
