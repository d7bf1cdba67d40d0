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
import org.junit.jupiter.api.TestInfo;
import org.junit.jupiter.api.TestReporter;

import io.furrow.control.alarm.Alarm;
import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmHandlers;
import io.furrow.control.alarm.AlarmState;
import io.furrow.control.alarm.Cause;
import io.furrow.control.manager.KeptOutbox;
import io.furrow.control.manager.StateJson;
import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.RejectedException;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

/** Random alarms, a webhook that fails at random, restarts: in the end it knows the newest state of all that it is to know of. */
class DeliveryPropertyTest {
    private static final int FARMS = 100;
    private static final int STEPS = 150;

    @Test
    void deliversTheFinalStateLast(TestInfo test, TestReporter reporter) {
        long seed = System.nanoTime();
        reporter.publishEntry(test.getDisplayName(), "seed " + seed);
        int received = 0;
        for (int i = 0; i < FARMS; i++) {
            Walk walk = new Walk(new Random(seed + i), "seed " + (seed + i) + " ");
            walk.run();
            received += walk.received.size();
        }
        assertThat(received).isGreaterThan(FARMS);
    }

    private static final class Walk {
        private final Random random;
        private final String said;
        private final KeptOutbox outbox = new KeptOutbox();
        private final AlarmCommandHandler handler = AlarmHandlers.writingTo(outbox);
        private final Map<String, Delivered> stored = new HashMap<>();
        /** What the webhook took, the newest of each alarm. */
        private final Map<String, Alarm> received = new HashMap<>();

        private final Map<String, String> deliveries = new HashMap<>();
        private final List<DeliveryQueue.Post> underWay = new ArrayList<>();
        private DeliveryQueue queue;
        private long now = 1_700_000_000_000L;
        private final long begun = now;
        private int shown;
        private boolean away;

        Walk(Random random, String said) {
            this.random = random;
            this.said = said;
            this.queue = queue();
        }

        void run() {
            for (int i = 0; i < STEPS; i++) {
                now += random.nextInt(30_000);
                step();
                show();
                post();
            }
            away = false;
            for (int i = 0; i < 200; i++) {
                now += 10_000;
                handler.passTime(now);
                show();
                queue.passTime(now);
                post();
            }
            check();
        }

        private void step() {
            switch (random.nextInt(10)) {
                case 0, 1, 2 -> handler.raise(new Cause(kind(), subject(), "x", List.of(), null), now);
                case 3, 4 -> handler.end(kind(), subject(), "over", now);
                case 5 -> many();
                case 6 -> ask();
                case 7 -> away = random.nextBoolean();
                case 8 -> restart();
                default -> handler.passTime(now);
            }
        }

        private void many() {
            Cause farm = Cause.ofMany(AlarmKind.SILENT_FARM, "data.raw", "x", List.of(), new Cause.Extent(9, 9));
            Cause some = Cause.ofMany(
                    AlarmKind.SILENT_DEVICE, "m", "x", List.of(), new Cause.Extent(1 + random.nextInt(9), 9));
            List<Cause> causes = new ArrayList<>();
            if (random.nextBoolean()) {
                handler.report(farm, null, now);
                causes.add(farm);
            }
            if (random.nextInt(3) > 0) {
                handler.report(some, causes.isEmpty() ? null : farm, now);
                causes.add(some);
            }
            handler.endOthers(java.util.Set.of(AlarmKind.SILENT_FARM, AlarmKind.SILENT_DEVICE), causes, "over", now);
        }

        private void ask() {
            try {
                AlarmCommand.Target target = new AlarmCommand.OfKind(kind(), null);
                String alarm = kind().code() + "-" + (1 + random.nextInt(60));
                handler.answer(
                        switch (random.nextInt(4)) {
                            case 0 -> new AlarmCommand.Mute(target, Duration.ofMinutes(1 + random.nextInt(10)));
                            case 1 -> new AlarmCommand.Unmute(target);
                            case 2 -> new AlarmCommand.Close(alarm, null);
                            default -> new AlarmCommand.Acknowledge(alarm, null);
                        },
                        now);
            } catch (RejectedException e) { // then nothing has changed
                assertThat(e.code()).as(said).isNotNull();
            }
        }

        /** What is under way may have been taken or not; the topics are read again, compacted. */
        private void restart() {
            for (DeliveryQueue.Post post : underWay) {
                if (random.nextBoolean()) {
                    receive(post);
                }
            }
            underWay.clear();
            queue = queue();
            stored.forEach(queue::restore);
            outbox.compacted(Topics.ALARMS)
                    .values()
                    .forEach(json -> queue.take(StateJson.read(json, Alarm.class), now));
            shown = outbox.all().size();
            queue.forgetMissing().forEach(this::store);
        }

        private void show() {
            List<KeptOutbox.Written> all = outbox.all();
            for (; shown < all.size(); shown++) {
                KeptOutbox.Written written = all.get(shown);
                if (written.value() == null) {
                    queue.remove(written.key()).ifPresent(this::store);
                } else {
                    queue.take(StateJson.read(written.value(), Alarm.class), now);
                }
            }
        }

        private void post() {
            for (int i = 0; i < 20; i++) {
                for (Optional<DeliveryQueue.Post> next = queue.next(now); next.isPresent(); next = queue.next(now)) {
                    DeliveryQueue.Post post = next.get();
                    underWay.add(post);
                    Optional.ofNullable(post.attempt()).ifPresent(this::store);
                }
                assertThat(underWay.size()).as(said).isLessThanOrEqualTo(DeliveryQueue.MAX_UNDER_WAY);
                assertThat(underWay)
                        .as(said)
                        .extracting(post -> post.alarm().alarm())
                        .doesNotHaveDuplicates();
                if (!underWay.isEmpty() && random.nextInt(4) > 0) {
                    DeliveryQueue.Post post = underWay.remove(random.nextInt(underWay.size()));
                    if (away) {
                        queue.completed(post, Webhook.Answer.failed("503"), now).ifPresent(this::store);
                    } else {
                        receive(post);
                        queue.completed(post, new Webhook.Answer(Webhook.Outcome.TAKEN, null, null), now)
                                .ifPresent(this::store);
                    }
                }
            }
        }

        private void receive(DeliveryQueue.Post post) {
            String body = new String(post.alarm().toBytes(), java.nio.charset.StandardCharsets.UTF_8);
            assertThat(deliveries.merge(post.id(), body, (before, after) -> before))
                    .as(said + "one id, one content")
                    .isEqualTo(body);
            Alarm before = received.put(post.alarm().alarm(), post.alarm());
            assertThat(before == null || before.sequence() <= post.alarm().sequence())
                    .as(said + "nothing older after what is newer")
                    .isTrue();
        }

        private void check() {
            outbox.compacted(Topics.ALARMS).values().forEach(json -> {
                Alarm alarm = StateJson.read(json, Alarm.class);
                Alarm known = received.get(alarm.alarm());
                boolean suppressed = alarm.isMuted(now) || alarm.inhibitedBy() != null;
                if (alarm.state() == AlarmState.CLOSED) {
                    boolean closedUnheard = known == null && (suppressed || alarm.mutedUntil() != null);
                    assertThat(closedUnheard || known != null && known.state() == AlarmState.CLOSED)
                            .as(said + alarm)
                            .isTrue();
                } else if (!suppressed) {
                    assertThat(known).as(said + alarm).isNotNull();
                    assertThat(known.sequence()).as(said + alarm).isEqualTo(alarm.sequence());
                }
            });
            assertThat(queue.waiting()).as(said).isZero();
        }

        private void store(DeliveryQueue.Update update) {
            if (update.delivered() == null) {
                stored.remove(update.alarm());
            } else {
                stored.put(update.alarm(), update.delivered());
            }
        }

        private DeliveryQueue queue() {
            return new DeliveryQueue(
                    Webhook.Settings.of(URI.create("http://127.0.0.1:1/")), begun, new Random(random.nextLong()));
        }

        private AlarmKind kind() {
            return random.nextBoolean() ? AlarmKind.COLLISION : AlarmKind.PREDICTED_ENCOUNTER;
        }

        private String subject() {
            return "s" + random.nextInt(5);
        }
    }
}
