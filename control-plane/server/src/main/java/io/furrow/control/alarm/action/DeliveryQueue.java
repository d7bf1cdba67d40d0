package io.furrow.control.alarm.action;

import java.time.Duration;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.Set;

import io.furrow.control.alarm.Alarm;
import io.furrow.control.alarm.AlarmState;
import io.furrow.control.alarm.Severity;
import io.furrow.model.time.Elapsed;

/**
 * Decides which alarm is posted next. Each alarm is posted in its newest state, the most severe first, until it is
 * accepted or rejected. A failed alarm is retried after a backoff of one second to five minutes, without blocking
 * others. Time is a parameter; the queue itself neither posts nor stores anything.
 *
 * <p>A muted or inhibited alarm waits until this ends. If it closes before, it is posted only if a post had been
 * attempted: the webhook may have accepted that one. Another alarm that opened and closed without having been posted is
 * posted once, as closed.
 */
final class DeliveryQueue {
    static final int MAX_IN_FLIGHT = 4;
    static final Duration MIN_BACKOFF = Duration.ofSeconds(1);
    static final Duration MAX_BACKOFF = Duration.ofMinutes(5);

    private static final int MAX_DOUBLINGS = 20;
    /** After this many consecutive failures the webhook is considered unavailable. */
    private static final int UNAVAILABLE_AFTER = 5;

    private static final Comparator<Entry> MOST_SEVERE_FIRST = Comparator.comparing(
                    (Entry entry) -> entry.newest.head().severity())
            .thenComparingLong(entry -> entry.readySince)
            .thenComparingLong(entry -> entry.newest.sequence());

    private final Webhook.Settings settings;
    private final long since;
    private final Random random;
    private final Map<String, Entry> entries = new HashMap<>();
    private final Set<Entry> waiting = new HashSet<>();
    private int inFlight;
    private int failuresInARow;
    private long holdUntil;

    /**
     * An alarm to be posted.
     *
     * @param id of the delivery: {@code <alarm>:<sequence>}, for a repetition {@code <alarm>:<sequence>:<number>}
     * @param attempt update to be stored before the post, because its response may be lost; null if an attempt is
     *     stored already
     */
    record Post(String id, Alarm alarm, int repeats, Update attempt) {}

    /**
     * A change of the stored deliveries.
     *
     * @param delivered null to delete the entry
     */
    record Update(String alarm, DeliveryState delivered) {}

    private static final class Entry {
        /** Null until the alarm was read. */
        private Alarm newest;
        /** Null until the alarm is posted. */
        private DeliveryState delivered;

        private boolean removed;
        private boolean inFlight;
        private int failures;
        private long readySince;
        private long notBefore;
    }

    /** @param since epoch ms: alarms that were closed earlier and never posted are not posted */
    DeliveryQueue(Webhook.Settings settings, long since, Random random) {
        this.settings = settings;
        this.since = since;
        this.random = random;
    }

    /** Restores an entry that an earlier queue stored. */
    void restore(String alarm, DeliveryState delivered) {
        entry(alarm).delivered = delivered;
    }

    void take(Alarm alarm, long now) {
        Entry entry = entry(alarm.alarm());
        entry.newest = alarm;
        entry.removed = false;
        decide(entry, now);
    }

    /** Handles the tombstone of an alarm: it is no longer posted, so that memory is bounded by the alarms on the topic. */
    Optional<Update> remove(String alarm) {
        Entry entry = entries.get(alarm);
        if (entry == null) {
            return Optional.empty();
        }
        entry.removed = true;
        waiting.remove(entry);
        return forgetIfDone(alarm, entry);
    }

    /** Whether the alarm is still waiting to be posted. */
    boolean isWaiting(String alarm) {
        Entry entry = entries.get(alarm);
        return entry != null && waiting.contains(entry);
    }

    /** Called periodically: ends mutes and repeats alarms that stay open. */
    void passTime(long now) {
        entries.values().forEach(entry -> decide(entry, now));
    }

    /** Returns the next post; empty if none is due or the maximum number is in flight. */
    Optional<Post> next(long now) {
        if (now < holdUntil || inFlight >= MAX_IN_FLIGHT) {
            return Optional.empty();
        }
        Optional<Entry> next =
                waiting.stream().filter(entry -> entry.notBefore <= now).min(MOST_SEVERE_FIRST);
        next.ifPresent(entry -> {
            waiting.remove(entry);
            entry.inFlight = true;
            inFlight++;
        });
        return next.map(entry -> post(entry, now));
    }

    private static Post post(Entry entry, long now) {
        Alarm alarm = entry.newest;
        boolean first = entry.delivered == null;
        if (first) {
            entry.delivered = DeliveryState.attempted(now);
        }
        boolean repeated = entry.delivered.sequence() == alarm.sequence();
        int repeats = repeated ? entry.delivered.repeats() + 1 : 0;
        String id = alarm.alarm() + ":" + alarm.sequence();
        Update attempt = first ? new Update(alarm.alarm(), entry.delivered) : null;
        return new Post(repeats == 0 ? id : id + ":" + repeats, alarm, repeats, attempt);
    }

    /** Handles the result of a post, also of one that an earlier queue began. */
    Optional<Update> completed(Post post, Webhook.Answer answer, long now) {
        Alarm alarm = post.alarm();
        Entry entry = entries.get(alarm.alarm());
        if (entry != null && entry.inFlight) {
            entry.inFlight = false;
            inFlight--;
        }
        if (answer.outcome() == Webhook.Outcome.FAILED) {
            failed(entry, answer, now);
            return entry == null ? Optional.empty() : forgetIfDone(alarm.alarm(), entry);
        }
        DeliveryState delivered = new DeliveryState(
                alarm.sequence(), alarm.state(), now, post.repeats(), answer.outcome() == Webhook.Outcome.REJECTED);
        if (failuresInARow >= UNAVAILABLE_AFTER) {
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
            long doubled = MIN_BACKOFF.toMillis() << Math.min(entry.failures - 1, MAX_DOUBLINGS);
            long backoff = Math.min(doubled, MAX_BACKOFF.toMillis());
            entry.notBefore = now + backoff / 2 + random.nextInt((int) backoff / 2 + 1);
            decide(entry, now);
        }
    }

    private void decide(Entry entry, long now) {
        boolean needed = !entry.inFlight && isNeeded(entry, now);
        if (!needed) {
            waiting.remove(entry);
        } else if (waiting.add(entry) && entry.failures == 0) {
            entry.readySince = Math.min(now, entry.newest.period().changed());
            entry.notBefore = entry.readySince + groupWait(entry);
        } else if (entry.failures == 0) {
            entry.notBefore = Math.min(entry.notBefore, entry.readySince + groupWait(entry));
        }
    }

    private long groupWait(Entry entry) {
        boolean first = entry.delivered == null && entry.newest.state() != AlarmState.CLOSED;
        boolean lesser = entry.newest.head().severity().compareTo(Severity.MAJOR) > 0;
        return first && lesser ? settings.groupWait().toMillis() : 0;
    }

    private boolean isNeeded(Entry entry, long now) {
        Alarm alarm = entry.newest;
        DeliveryState existing = entry.delivered;
        if (alarm == null || entry.removed || existing != null && existing.sequence() > alarm.sequence()) {
            return false;
        }
        boolean suppressed = alarm.isMuted(now) || alarm.inhibitedBy() != null;
        if (alarm.state() == AlarmState.CLOSED) {
            return existing == null
                    ? !suppressed && alarm.period().changed() >= since
                    : existing.state() != AlarmState.CLOSED;
        }
        if (suppressed) {
            return false;
        }
        boolean isRepeatable = alarm.state() == AlarmState.OPEN
                && existing != null
                && !existing.refused()
                && Elapsed.hasPassed(settings.repeatInterval().toMillis(), existing.time(), now);
        return existing == null || existing.sequence() != alarm.sequence() || isRepeatable;
    }

    private Optional<Update> forgetIfDone(String alarm, Entry entry) {
        if (!entry.removed || entry.inFlight) {
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

    int inFlight() {
        return inFlight;
    }

    /** Called once all existing alarms were read: returns the deletions of entries for alarms that no longer exist. */
    List<Update> forgetMissing() {
        List<Update> missing = entries.entrySet().stream()
                .filter(each -> each.getValue().newest == null)
                .map(each -> new Update(each.getKey(), null))
                .toList();
        missing.forEach(each -> entries.remove(each.alarm()));
        return missing;
    }
}
