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
import io.furrow.control.alarm.action.DeliveryQueue.Post;
import io.furrow.control.alarm.action.DeliveryQueue.Update;
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
        assertThat(ids(due())).containsExactly(collision.alarm(), silent.alarm(), predicted.alarm());
    }

    @Test
    void limitsPostsInFlightToFour() {
        for (int i = 0; i < 10; i++) {
            take(AlarmKind.COLLISION);
        }
        assertThat(due()).hasSize(DeliveryQueue.MAX_IN_FLIGHT);
        assertThat(queue.waiting()).isEqualTo(6);
    }

    @Test
    void doesNotDelayOthersAfterAFailure() {
        Alarm failing = take(AlarmKind.COLLISION);
        for (int i = 0; i < 5; i++) {
            complete(due().get(0), FAILED);
            assertThat(due()).isEmpty();
            Alarm other = take(AlarmKind.PREDICTED_ENCOUNTER);
            List<Post> posts = due();
            assertThat(ids(posts)).containsExactly(other.alarm());
            complete(posts.get(0), ACCEPTED);
            now += DeliveryQueue.MAX_BACKOFF.toMillis();
        }
        assertThat(ids(due())).containsExactly(failing.alarm());
    }

    @Test
    void backsOffFromASecondToFiveMinutes() {
        take(AlarmKind.COLLISION);
        List<Long> pauses = new ArrayList<>();
        List<Post> due = due();
        for (int i = 0; i < 12; i++) {
            complete(due.get(0), FAILED);
            long failed = now;
            for (due = due(); due.isEmpty(); due = due()) {
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
            for (Post post : due()) {
                complete(post, FAILED);
                attempts++;
            }
            now += 1000;
            if (now == NOW + 60_000) {
                queue.take(closed(passing), now);
            }
        }
        assertThat(attempts).isBetween(20, 120);
        Map<String, AlarmState> delivered = new HashMap<>();
        while (delivered.size() < 2 && now < end + DeliveryQueue.MAX_BACKOFF.toMillis()) {
            for (Post post : due()) {
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
            due().forEach(post -> complete(post, FAILED));
            now += DeliveryQueue.MAX_BACKOFF.toMillis();
        }
        List<Post> both = due();
        complete(both.get(0), FAILED);
        assertThat(due()).isEmpty();
        complete(both.get(1), ACCEPTED);
        assertThat(due()).hasSize(1);
    }

    @Test
    void respectsRetryAfter() {
        take(AlarmKind.COLLISION);
        complete(due().get(0), new Webhook.Answer(Webhook.Outcome.FAILED, "429", Duration.ofMinutes(10)));
        take(AlarmKind.COLLISION);
        now += Duration.ofMinutes(10).toMillis() - 1;
        assertThat(due()).isEmpty();
        now += 1;
        assertThat(due()).hasSize(2);
    }

    @Test
    void postsOnlyTheNewestStateWithTheIdOfItsChange() {
        Alarm alarm = take(AlarmKind.COLLISION);
        Post first = due().get(0);
        assertThat(first.id()).isEqualTo("collision-1:1");
        Alarm acknowledged =
                alarm.become(AlarmState.ACKNOWLEDGED, "ann", null, now).numbered(2);
        queue.take(acknowledged, now);
        queue.take(acknowledged.become(AlarmState.CLOSED, "ann", "over", now).numbered(3), now);
        assertThat(due()).as("one post of an alarm at a time").isEmpty();
        complete(first, ACCEPTED);
        List<Post> next = due();
        assertThat(next).extracting(Post::id).containsExactly("collision-1:3");
        complete(next.get(0), FAILED);
        now += 1000;
        assertThat(due()).extracting(Post::id).containsExactly("collision-1:3");
    }

    @Test
    void doesNotRepeatARejectedAlarm() {
        Alarm alarm = take(AlarmKind.COLLISION);
        complete(due().get(0), REJECTED);
        now += SETTINGS.repeatInterval().multipliedBy(2).toMillis();
        queue.passTime(now);
        assertThat(due()).isEmpty();
        assertThat(stored.get(alarm.alarm()).refused()).isTrue();
    }

    @Test
    void repeatsOpenAlarmsUntilTheyAreAcknowledged() {
        Alarm open = take(AlarmKind.COLLISION);
        Alarm acknowledged = take(AlarmKind.COLLISION);
        queue.take(
                acknowledged.become(AlarmState.ACKNOWLEDGED, "ann", null, now).numbered(++sequence), now);
        due().forEach(post -> complete(post, ACCEPTED));
        due().forEach(post -> complete(post, ACCEPTED));
        now += SETTINGS.repeatInterval().toMillis() - 1;
        queue.passTime(now);
        assertThat(due()).isEmpty();
        now += 1;
        queue.passTime(now);
        List<Post> repeated = due();
        assertThat(repeated).extracting(Post::id).containsExactly(open.alarm() + ":1:1");
        complete(repeated.get(0), ACCEPTED);
        now += SETTINGS.repeatInterval().toMillis();
        queue.passTime(now);
        assertThat(due()).extracting(Post::id).containsExactly(open.alarm() + ":1:2");
    }

    @Test
    void repeatsAnAlarmThatWasPostedWhenTheClockWasAhead() {
        Alarm open = take(AlarmKind.COLLISION);
        complete(due().get(0), ACCEPTED);
        now -= 7_200_000;
        queue.passTime(now);
        assertThat(due()).extracting(Post::id).containsExactly(open.alarm() + ":1:1");
    }

    @Test
    void delaysAMinorAlarmForAnInhibitingOne() {
        Alarm minor = take(AlarmKind.SILENT_DEVICE);
        assertThat(due()).isEmpty();
        now += 5_000;
        queue.take(minor.inhibited("silent-mission-2", now).numbered(++sequence), now);
        now += 60_000;
        assertThat(due()).isEmpty();
        queue.take(closed(minor).inhibitedFromStart("silent-mission-2"), now);
        assertThat(due()).as("closed while inhibited, never posted").isEmpty();

        Alarm alone = take(AlarmKind.SILENT_DEVICE);
        now += SETTINGS.groupWait().toMillis() - 1;
        assertThat(due()).isEmpty();
        now += 1;
        assertThat(ids(due())).containsExactly(alone.alarm());
    }

    @Test
    void postsTheEndOfAPostedAlarmAlsoWhileInhibitedOrMuted() {
        Alarm alarm = take(AlarmKind.COLLISION);
        complete(due().get(0), ACCEPTED);
        Alarm muted = alarm.muted(now + 100_000, now).numbered(++sequence);
        queue.take(muted, now);
        assertThat(due()).isEmpty();
        queue.take(closed(muted), now);
        assertThat(due()).extracting(post -> post.alarm().state()).containsExactly(AlarmState.CLOSED);
    }

    @Test
    void continuesAfterARestart() {
        Alarm first = take(AlarmKind.COLLISION);
        complete(due().get(0), ACCEPTED);
        Alarm second = take(AlarmKind.COLLISION);
        Alarm closed = closed(take(AlarmKind.COLLISION));
        Alarm old = Alarm.raised(cause(AlarmKind.COLLISION, "old"), null, ++sequence, now - 2)
                .become(AlarmState.CLOSED, null, "over", now - 1);

        restart();
        List.of(first, second, closed, old).forEach(alarm -> queue.take(alarm, now));
        assertThat(ids(due())).containsExactlyInAnyOrder(second.alarm(), closed.alarm());
    }

    /** The response to its post was lost with the process. */
    @Test
    void postsTheEndOfAnInhibitedAlarmThatMayHaveBeenAccepted() {
        Alarm alarm = take(AlarmKind.SILENT_DEVICE);
        now += SETTINGS.groupWait().toMillis();
        assertThat(ids(due())).containsExactly(alarm.alarm());

        restart();
        Alarm inhibited = alarm.inhibited("silent-farm-1", now).numbered(++sequence);
        queue.take(inhibited, now);
        assertThat(due()).isEmpty();
        queue.take(closed(inhibited), now);

        assertThat(due()).extracting(post -> post.alarm().state()).containsExactly(AlarmState.CLOSED);
    }

    @Test
    void removesEntriesOfRemovedAlarms() {
        Alarm existing = take(AlarmKind.COLLISION);
        complete(due().get(0), ACCEPTED);
        assertThat(queue.remove(existing.alarm())).contains(new Update(existing.alarm(), null));
        Alarm unposted = take(AlarmKind.COLLISION);
        assertThat(queue.isWaiting(unposted.alarm())).isTrue();
        assertThat(queue.remove(unposted.alarm())).isEmpty();
        assertThat(due()).isEmpty();
        Alarm inFlight = take(AlarmKind.COLLISION);
        Post post = due().get(0);
        assertThat(queue.remove(inFlight.alarm())).isEmpty();
        assertThat(queue.completed(post, ACCEPTED, now)).contains(new Update(inFlight.alarm(), null));
        assertThat(queue.inFlight()).isZero();

        queue.restore("nosuch", new DeliveryState(1, AlarmState.OPEN, now, 0, false));
        assertThat(queue.forgetMissing()).containsExactly(new Update("nosuch", null));
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

    private Alarm closed(Alarm alarm) {
        return alarm.become(AlarmState.CLOSED, null, "over", now).numbered(++sequence);
    }

    private static Cause cause(AlarmKind kind, String subject) {
        return new Cause(kind, subject, "x", List.of(), null);
    }

    private List<Post> due() {
        List<Post> all = new ArrayList<>();
        for (Optional<Post> next = queue.next(now); next.isPresent(); next = queue.next(now)) {
            all.add(next.get());
            Optional.ofNullable(next.get().attempt()).ifPresent(this::store);
        }
        return all;
    }

    private static List<String> ids(List<Post> all) {
        return all.stream().map(post -> post.alarm().alarm()).toList();
    }

    private void complete(Post post, Webhook.Answer answer) {
        queue.completed(post, answer, now).ifPresent(this::store);
    }

    private void store(Update update) {
        stored.compute(update.alarm(), (alarm, before) -> update.delivered());
    }
}
