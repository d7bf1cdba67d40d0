package io.furrow.control.alarm.action;

import java.net.URI;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;

import org.junit.jupiter.api.Test;

import io.furrow.control.alarm.Alarm;
import io.furrow.control.alarm.AlarmState;
import io.furrow.control.alarm.Cause;
import io.furrow.model.control.AlarmKind;

import static org.assertj.core.api.Assertions.assertThat;

class DeliveryQueueTest {
    private static final long NOW = 1_700_000_000_000L;
    private static final Webhook.Settings SETTINGS = Webhook.Settings.of(URI.create("http://127.0.0.1:1/"));
    private static final Webhook.Answer ACCEPTED = new Webhook.Answer(Webhook.Outcome.ACCEPTED, null, null);
    private static final Webhook.Answer REJECTED = new Webhook.Answer(Webhook.Outcome.REJECTED, "410", null);
    private static final Webhook.Answer FAILED = Webhook.Answer.failed("503");

    private final Map<String, DeliveryState> stored = new HashMap<>();
    private DeliveryQueue queue = new DeliveryQueue(SETTINGS, NOW, new Random(7));
    private long now = NOW;
    private long sequence;

    @Test
    void postsTheMostSevereFirst() {
        Alarm silent = take(AlarmKind.SILENT_MISSION);
        Alarm collision = take(AlarmKind.COLLISION);
        Alarm predicted = take(AlarmKind.PREDICTED_ENCOUNTER);
        assertThat(ids(all())).containsExactly(collision.alarm(), silent.alarm(), predicted.alarm());
    }

    @Test
    void limitsPostsInFlightToFour() {
        for (int i = 0; i < 10; i++) {
            take(AlarmKind.COLLISION);
        }
        assertThat(all()).hasSize(DeliveryQueue.MAX_IN_FLIGHT);
        assertThat(queue.waiting()).isEqualTo(6);
    }

    @Test
    void doesNotDelayOthersAfterAFailure() {
        Alarm failing = take(AlarmKind.COLLISION);
        for (int i = 0; i < 5; i++) {
            complete(all().get(0), FAILED);
            assertThat(all()).isEmpty();
            Alarm other = take(AlarmKind.PREDICTED_ENCOUNTER);
            List<DeliveryQueue.Post> posts = all();
            assertThat(ids(posts)).containsExactly(other.alarm());
            complete(posts.get(0), ACCEPTED);
            now += DeliveryQueue.MAX_BACKOFF.toMillis();
        }
        assertThat(ids(all())).containsExactly(failing.alarm());
    }

    @Test
    void backsOffFromASecondToFiveMinutes() {
        take(AlarmKind.COLLISION);
        List<Long> pauses = new ArrayList<>();
        List<DeliveryQueue.Post> due = all();
        for (int i = 0; i < 12; i++) {
            complete(due.get(0), FAILED);
            long failed = now;
            for (due = all(); due.isEmpty(); due = all()) {
                now += 100;
            }
            pauses.add(now - failed);
        }
        assertThat(pauses.get(0)).isBetween(500L, 1100L);
        assertThat(pauses.get(1)).isBetween(1000L, 2100L);
        assertThat(pauses.get(11)).isBetween(150_000L, 300_100L);
    }

    @Test
    void losesNothingWhileTheWebhookIsUnavailableForAnHour() {
        Alarm open = take(AlarmKind.SILENT_MISSION);
        Alarm passing = take(AlarmKind.COLLISION);
        long end = now + Duration.ofHours(1).toMillis();
        int attempts = 0;
        while (now < end) {
            for (DeliveryQueue.Post post : all()) {
                complete(post, FAILED);
                attempts++;
            }
            now += 1000;
            if (now == NOW + 60_000) {
                queue.take(passing.become(AlarmState.CLOSED, null, "over", now).numbered(++sequence), now);
            }
        }
        assertThat(attempts).isBetween(20, 120);
        Map<String, AlarmState> delivered = new HashMap<>();
        while (delivered.size() < 2 && now < end + DeliveryQueue.MAX_BACKOFF.toMillis()) {
            for (DeliveryQueue.Post post : all()) {
                delivered.put(post.alarm().alarm(), post.alarm().state());
                complete(post, ACCEPTED);
            }
            now += 1000;
        }
        assertThat(delivered).isEqualTo(Map.of(open.alarm(), AlarmState.OPEN, passing.alarm(), AlarmState.CLOSED));
    }

    @Test
    void endsAllBackoffsOnceTheWebhookRecovers() {
        take(AlarmKind.COLLISION);
        take(AlarmKind.COLLISION);
        for (int i = 0; i < 8; i++) {
            all().forEach(post -> complete(post, FAILED));
            now += DeliveryQueue.MAX_BACKOFF.toMillis();
        }
        List<DeliveryQueue.Post> both = all();
        complete(both.get(0), FAILED);
        assertThat(all()).isEmpty();
        complete(both.get(1), ACCEPTED);
        assertThat(all()).hasSize(1);
    }

    @Test
    void respectsRetryAfter() {
        take(AlarmKind.COLLISION);
        complete(all().get(0), new Webhook.Answer(Webhook.Outcome.FAILED, "429", Duration.ofMinutes(10)));
        take(AlarmKind.COLLISION);
        now += Duration.ofMinutes(10).toMillis() - 1;
        assertThat(all()).isEmpty();
        now += 1;
        assertThat(all()).hasSize(2);
    }

    @Test
    void postsOnlyTheNewestStateWithTheIdOfItsChange() {
        Alarm alarm = take(AlarmKind.COLLISION);
        DeliveryQueue.Post first = all().get(0);
        assertThat(first.id()).isEqualTo("collision-1:1");
        Alarm acknowledged =
                alarm.become(AlarmState.ACKNOWLEDGED, "ann", null, now).numbered(2);
        queue.take(acknowledged, now);
        queue.take(acknowledged.become(AlarmState.CLOSED, "ann", "over", now).numbered(3), now);
        assertThat(all()).as("one post of an alarm at a time").isEmpty();
        complete(first, ACCEPTED);
        List<DeliveryQueue.Post> next = all();
        assertThat(next).extracting(DeliveryQueue.Post::id).containsExactly("collision-1:3");
        complete(next.get(0), FAILED);
        now += 1000;
        assertThat(all()).extracting(DeliveryQueue.Post::id).containsExactly("collision-1:3");
    }

    @Test
    void doesNotRepeatARejectedAlarm() {
        Alarm alarm = take(AlarmKind.COLLISION);
        complete(all().get(0), REJECTED);
        now += SETTINGS.repeatInterval().multipliedBy(2).toMillis();
        queue.passTime(now);
        assertThat(all()).isEmpty();
        assertThat(stored.get(alarm.alarm()).refused()).isTrue();
    }

    @Test
    void repeatsOpenAlarmsUntilTheyAreAcknowledged() {
        Alarm open = take(AlarmKind.COLLISION);
        Alarm seen = take(AlarmKind.COLLISION);
        queue.take(seen.become(AlarmState.ACKNOWLEDGED, "ann", null, now).numbered(++sequence), now);
        all().forEach(post -> complete(post, ACCEPTED));
        all().forEach(post -> complete(post, ACCEPTED));
        now += SETTINGS.repeatInterval().toMillis() - 1;
        queue.passTime(now);
        assertThat(all()).isEmpty();
        now += 1;
        queue.passTime(now);
        List<DeliveryQueue.Post> again = all();
        assertThat(again).extracting(DeliveryQueue.Post::id).containsExactly(open.alarm() + ":1:1");
        complete(again.get(0), ACCEPTED);
        now += SETTINGS.repeatInterval().toMillis();
        queue.passTime(now);
        assertThat(all()).extracting(DeliveryQueue.Post::id).containsExactly(open.alarm() + ":1:2");
    }

    @Test
    void delaysAMinorAlarmForAnInhibitingOne() {
        Alarm minor = take(AlarmKind.SILENT_DEVICE);
        assertThat(all()).isEmpty();
        now += 5_000;
        queue.take(minor.inhibited("silent-mission-2", now).numbered(++sequence), now);
        now += 60_000;
        assertThat(all()).isEmpty();
        queue.take(
                minor.become(AlarmState.CLOSED, null, "over", now)
                        .inhibitedFromStart("silent-mission-2")
                        .numbered(++sequence),
                now);
        assertThat(all())
                .as("closed while it was inhibited, and nobody knows of it")
                .isEmpty();

        Alarm alone = take(AlarmKind.SILENT_DEVICE);
        now += SETTINGS.groupWait().toMillis() - 1;
        assertThat(all()).isEmpty();
        now += 1;
        assertThat(ids(all())).containsExactly(alone.alarm());
    }

    @Test
    void postsTheEndOfAPostedAlarmAlsoWhileInhibitedOrMuted() {
        Alarm alarm = take(AlarmKind.COLLISION);
        complete(all().get(0), ACCEPTED);
        Alarm muted = alarm.muted(now + 100_000, now).numbered(++sequence);
        queue.take(muted, now);
        assertThat(all()).isEmpty();
        queue.take(muted.become(AlarmState.CLOSED, null, "over", now).numbered(++sequence), now);
        assertThat(all()).extracting(post -> post.alarm().state()).containsExactly(AlarmState.CLOSED);
    }

    @Test
    void continuesAfterARestart() {
        Alarm first = take(AlarmKind.COLLISION);
        complete(all().get(0), ACCEPTED);
        Alarm second = take(AlarmKind.COLLISION);
        Alarm closed = take(AlarmKind.COLLISION)
                .become(AlarmState.CLOSED, null, "over", now)
                .numbered(++sequence);
        Alarm old = Alarm.raised(cause(AlarmKind.COLLISION, "old"), null, ++sequence, now - 2)
                .become(AlarmState.CLOSED, null, "over", now - 1);

        restart();
        List.of(first, second, closed, old).forEach(alarm -> queue.take(alarm, now));
        assertThat(ids(all())).containsExactlyInAnyOrder(second.alarm(), closed.alarm());
    }

    /** The response to its post was lost with the process. */
    @Test
    void postsTheEndOfAnInhibitedAlarmThatMayHaveBeenAccepted() {
        Alarm alarm = take(AlarmKind.SILENT_DEVICE);
        now += SETTINGS.groupWait().toMillis();
        assertThat(ids(all())).containsExactly(alarm.alarm());

        restart();
        Alarm inhibited = alarm.inhibited("silent-farm-1", now).numbered(++sequence);
        queue.take(inhibited, now);
        assertThat(all()).isEmpty();
        queue.take(inhibited.become(AlarmState.CLOSED, null, "over", now).numbered(++sequence), now);

        assertThat(all()).extracting(post -> post.alarm().state()).containsExactly(AlarmState.CLOSED);
    }

    @Test
    void removesEntriesOfRemovedAlarms() {
        Alarm existing = take(AlarmKind.COLLISION);
        complete(all().get(0), ACCEPTED);
        assertThat(queue.remove(existing.alarm())).contains(new DeliveryQueue.Update(existing.alarm(), null));
        Alarm unposted = take(AlarmKind.COLLISION);
        assertThat(queue.isWaiting(unposted.alarm())).isTrue();
        assertThat(queue.remove(unposted.alarm())).isEmpty();
        assertThat(all()).isEmpty();
        Alarm inFlight = take(AlarmKind.COLLISION);
        DeliveryQueue.Post post = all().get(0);
        assertThat(queue.remove(inFlight.alarm())).isEmpty();
        assertThat(queue.completed(post, ACCEPTED, now)).contains(new DeliveryQueue.Update(inFlight.alarm(), null));
        assertThat(queue.inFlight()).isZero();

        queue.restore("nosuch", new DeliveryState(1, AlarmState.OPEN, now, 0, false));
        assertThat(queue.forgetMissing()).containsExactly(new DeliveryQueue.Update("nosuch", null));
        assertThat(queue.forgetMissing()).isEmpty();
    }

    private void restart() {
        queue = new DeliveryQueue(SETTINGS, now, new Random(7));
        stored.forEach(queue::restore);
    }

    private Alarm take(AlarmKind kind) {
        Alarm alarm = Alarm.raised(cause(kind, "s" + sequence), null, ++sequence, now);
        queue.take(alarm, now);
        return alarm;
    }

    private static Cause cause(AlarmKind kind, String subject) {
        return new Cause(kind, subject, "x", List.of(), null);
    }

    private List<DeliveryQueue.Post> all() {
        List<DeliveryQueue.Post> all = new ArrayList<>();
        for (Optional<DeliveryQueue.Post> next = queue.next(now); next.isPresent(); next = queue.next(now)) {
            all.add(next.get());
            Optional.ofNullable(next.get().attempt()).ifPresent(this::store);
        }
        return all;
    }

    private static List<String> ids(List<DeliveryQueue.Post> all) {
        return all.stream().map(post -> post.alarm().alarm()).toList();
    }

    private void complete(DeliveryQueue.Post post, Webhook.Answer answer) {
        queue.completed(post, answer, now).ifPresent(this::store);
    }

    private void store(DeliveryQueue.Update update) {
        if (update.delivered() == null) {
            stored.remove(update.alarm());
        } else {
            stored.put(update.alarm(), update.delivered());
        }
    }
}
