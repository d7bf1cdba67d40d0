package io.furrow.control.alarm;

import java.time.Duration;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.Set;

/**
 * Decides which alarm is posted next. Each is posted in its newest state, the most severe first, until it is taken or refused; one
 * that fails waits, alone, for one second to five minutes. Time is data; nothing here is posted or stored.
 *
 * <p>An alarm that is muted or inhibited waits until it is no longer; if it closes before, it is only posted where it had been
 * posted before. One that opened and closed without having been posted is posted once, closed.
 */
final class DeliveryQueue {
    static final int MAX_UNDER_WAY = 4;
    static final Duration LEAST_BACKOFF = Duration.ofSeconds(1);
    static final Duration MAX_BACKOFF = Duration.ofMinutes(5);

    private static final int MAX_DOUBLINGS = 20;
    /** So many failures in a row are those of the other side rather than of single alarms. */
    private static final int AWAY_AFTER = 5;

    private static final Comparator<Entry> MOST_SEVERE_FIRST = Comparator.comparing(
                    (Entry entry) -> entry.newest.severity())
            .thenComparingLong(entry -> entry.readySince)
            .thenComparingLong(entry -> entry.newest.sequence());

    private final Webhook.Settings settings;
    private final long since;
    private final Random random;
    private final Map<String, Entry> entries = new HashMap<>();
    private final Set<Entry> waiting = new HashSet<>();
    private int underWay;
    private int failuresInARow;
    private long holdUntil;

    /**
     * An alarm to be posted.
     *
     * @param id of the delivery: {@code <alarm>:<sequence>}, of a repetition {@code <alarm>:<sequence>:<number>}
     */
    record Post(String id, Alarm alarm, int repeats) {}

    /** What is to be stored of an alarm. @param delivered null for nothing any more */
    record Update(String alarm, Delivered delivered) {}

    /** What is known of one alarm. */
    private static final class Entry {
        /** Null before it was read. */
        private Alarm newest;
        /** Null before it was posted. */
        private Delivered delivered;

        private boolean removed;
        private boolean underWay;
        private int failures;
        private long readySince;
        private long notBefore;
    }

    /** @param since epoch ms: alarms that were closed before and never posted are no news */
    DeliveryQueue(Webhook.Settings settings, long since, Random random) {
        this.settings = settings;
        this.since = since;
        this.random = random;
    }

    /** What was stored by an earlier queue. */
    void restore(String alarm, Delivered delivered) {
        entry(alarm).delivered = delivered;
    }

    void take(Alarm alarm, long now) {
        Entry entry = entry(alarm.alarm());
        entry.newest = alarm;
        entry.removed = false;
        decide(entry, now);
    }

    /** The alarm is gone from the topic: memory is bounded by what is there, so it is not posted any more. */
    Optional<Update> remove(String alarm) {
        Entry entry = entries.get(alarm);
        if (entry == null) {
            return Optional.empty();
        }
        entry.removed = true;
        waiting.remove(entry);
        return forgetIfDone(alarm, entry);
    }

    /** Whether it is still to be posted. */
    boolean isWaiting(String alarm) {
        Entry entry = entries.get(alarm);
        return entry != null && waiting.contains(entry);
    }

    /** Called now and then: mutes end, and what lasts is posted again. */
    void passTime(long now) {
        entries.values().forEach(entry -> decide(entry, now));
    }

    /** The next to be posted; empty where none is due, or enough are under way. */
    Optional<Post> next(long now) {
        if (now < holdUntil || underWay >= MAX_UNDER_WAY) {
            return Optional.empty();
        }
        Optional<Entry> next =
                waiting.stream().filter(entry -> entry.notBefore <= now).min(MOST_SEVERE_FIRST);
        next.ifPresent(entry -> {
            waiting.remove(entry);
            entry.underWay = true;
            underWay++;
        });
        return next.map(DeliveryQueue::post);
    }

    private static Post post(Entry entry) {
        Alarm alarm = entry.newest;
        boolean again = entry.delivered != null && entry.delivered.sequence() == alarm.sequence();
        int repeats = again ? entry.delivered.repeats() + 1 : 0;
        String id = "%s:%d".formatted(alarm.alarm(), alarm.sequence());
        return new Post(repeats == 0 ? id : id + ":" + repeats, alarm, repeats);
    }

    /** What came of a post, also of one that an earlier queue began. */
    Optional<Update> completed(Post post, Webhook.Answer answer, long now) {
        Alarm alarm = post.alarm();
        Entry entry = entries.get(alarm.alarm());
        if (entry != null && entry.underWay) {
            entry.underWay = false;
            underWay--;
        }
        if (answer.outcome() == Webhook.Outcome.FAILED) {
            failed(entry, answer, now);
            return entry == null ? Optional.empty() : forgetIfDone(alarm.alarm(), entry);
        }
        Delivered delivered = new Delivered(
                alarm.sequence(), alarm.state(), now, post.repeats(), answer.outcome() == Webhook.Outcome.REFUSED);
        if (failuresInARow >= AWAY_AFTER) {
            waiting.forEach(each -> each.notBefore = each.failures > 0 ? now : each.notBefore);
        }
        failuresInARow = 0;
        if (entry == null) {
            return Optional.of(new Update(alarm.alarm(), delivered));
        }
        entry.delivered = delivered;
        entry.failures = 0;
        decide(entry, now);
        return forgetIfDone(alarm.alarm(), entry).or(() -> Optional.of(new Update(alarm.alarm(), delivered)));
    }

    private void failed(Entry entry, Webhook.Answer answer, long now) {
        failuresInARow++;
        if (answer.retryAfter() != null) {
            holdUntil = Math.max(holdUntil, now + answer.retryAfter().toMillis());
        }
        if (entry != null) {
            entry.failures++;
            long doubled = LEAST_BACKOFF.toMillis() << Math.min(entry.failures - 1, MAX_DOUBLINGS);
            long backoff = Math.min(doubled, MAX_BACKOFF.toMillis());
            entry.notBefore = now + backoff / 2 + random.nextInt((int) backoff / 2 + 1);
            decide(entry, now);
        }
    }

    private void decide(Entry entry, long now) {
        boolean needed = !entry.underWay && isNeeded(entry, now);
        if (!needed) {
            waiting.remove(entry);
        } else if (waiting.add(entry) && entry.failures == 0) {
            entry.readySince = Math.min(now, entry.newest.changed());
            entry.notBefore = entry.readySince + groupWait(entry);
        } else if (entry.failures == 0) {
            entry.notBefore = Math.min(entry.notBefore, entry.readySince + groupWait(entry));
        }
    }

    private long groupWait(Entry entry) {
        boolean first = entry.delivered == null && entry.newest.state() != AlarmState.CLOSED;
        boolean lesser = entry.newest.severity().compareTo(Severity.MAJOR) > 0;
        return first && lesser ? settings.groupWait().toMillis() : 0;
    }

    private boolean isNeeded(Entry entry, long now) {
        Alarm alarm = entry.newest;
        Delivered known = entry.delivered;
        if (alarm == null || entry.removed || known != null && known.sequence() > alarm.sequence()) {
            return false;
        }
        boolean suppressed = alarm.isMuted(now) || alarm.inhibitedBy() != null;
        if (alarm.state() == AlarmState.CLOSED) {
            return known == null ? !suppressed && alarm.changed() >= since : known.state() != AlarmState.CLOSED;
        }
        if (suppressed) {
            return false;
        }
        boolean lasts = alarm.state() == AlarmState.OPEN
                && known != null
                && now - known.time() >= settings.repeatInterval().toMillis();
        return known == null || known.sequence() != alarm.sequence() || lasts;
    }

    private Optional<Update> forgetIfDone(String alarm, Entry entry) {
        if (!entry.removed || entry.underWay) {
            return Optional.empty();
        }
        entries.remove(alarm);
        return entry.delivered == null ? Optional.empty() : Optional.of(new Update(alarm, null));
    }

    private Entry entry(String alarm) {
        return entries.computeIfAbsent(alarm, any -> new Entry());
    }

    int waiting() {
        return waiting.size();
    }

    int underWay() {
        return underWay;
    }

    /** Called once all alarms were taken that there are: what was stored of others is to be stored no more. */
    List<Update> forgetMissing() {
        List<Update> missing = entries.entrySet().stream()
                .filter(each -> each.getValue().newest == null)
                .map(each -> new Update(each.getKey(), null))
                .toList();
        missing.forEach(each -> entries.remove(each.alarm()));
        return missing;
    }
}
