package io.furrow.provisioner.account;

import java.util.Map;
import java.util.Set;
import java.util.function.UnaryOperator;

import io.furrow.kafka.BoundedMap;

/**
 * Records the logins of a limited number of users, evicting the least recently active one. Names and topics are bounded
 * too, because clients choose them. Thread-safe.
 */
final class LoginHistory {
    private static final int MAX_USER = 1024;
    private static final int MAX_TOPIC = 256;

    private final Map<String, LoginReport> byUser;

    LoginHistory(int max) {
        byUser = BoundedMap.byAccess(max);
    }

    void loggedIn(String user, long now) {
        update(user, entry -> entry.loggedIn(now));
    }

    void refused(String user, String reason, long now) {
        update(user, entry -> entry.refused(user, reason, now));
    }

    void published(String user, String topic, long now) {
        String begin = topic.length() > MAX_TOPIC ? topic.substring(0, MAX_TOPIC) + "…" : topic;
        update(user, entry -> entry.published(begin, now));
    }

    synchronized void retain(Set<String> users) {
        byUser.keySet().retainAll(users);
    }

    synchronized Map<String, LoginReport> reports() {
        return Map.copyOf(byUser);
    }

    private synchronized void update(String user, UnaryOperator<LoginReport> change) {
        if (user.length() <= MAX_USER) {
            byUser.put(user, change.apply(byUser.getOrDefault(user, LoginReport.NONE)));
        }
    }
}
