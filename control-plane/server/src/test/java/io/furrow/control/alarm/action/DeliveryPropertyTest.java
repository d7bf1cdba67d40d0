package io.furrow.control.alarm.action;

import java.net.URI;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInfo;
import org.junit.jupiter.api.TestReporter;

import io.furrow.control.alarm.Alarm;
import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmHandlerFixture;
import io.furrow.control.alarm.AlarmState;
import io.furrow.control.alarm.Cause;
import io.furrow.control.manager.CapturingPublisher;
import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.RejectedException;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

/** Applies random alarms, failures of the webhook and restarts: in the end the webhook has the newest state of all relevant alarms. */
class DeliveryPropertyTest {
    private static final int FARMS = 100;
    private static final int STEPS = 150;

    @Tag("full")
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
        private final String label;
        private final CapturingPublisher publisher = new CapturingPublisher();
        private final AlarmCommandHandler handler = AlarmHandlerFixture.writingTo(publisher);
        private final Map<String, DeliveryState> stored = new HashMap<>();
        /** Newest accepted state of each alarm. */
        private final Map<String, Alarm> received = new HashMap<>();

        private final Map<String, String> deliveries = new HashMap<>();
        private final List<DeliveryQueue.Post> inFlight = new ArrayList<>();
        private DeliveryQueue queue;
        private long now = 1_700_000_000_000L;
        private final long begun = now;
        private int shown;
        private boolean unavailable;

        Walk(Random random, String label) {
            this.random = random;
            this.label = label;
            this.queue = queue();
        }

        void run() {
            for (int i = 0; i < STEPS; i++) {
                now += random.nextInt(30_000);
                step();
                show();
                post();
            }
            unavailable = false;
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
                case 6 -> request();
                case 7 -> unavailable = random.nextBoolean();
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

        private void request() {
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
            } catch (RejectedException e) { // then nothing changed
                assertThat(e.code()).as(label).isNotNull();
            }
        }

        /** Posts in flight may or may not be accepted; the compacted topics are read again. */
        private void restart() {
            for (DeliveryQueue.Post post : inFlight) {
                if (random.nextBoolean()) {
                    receive(post);
                }
            }
            inFlight.clear();
            queue = queue();
            stored.forEach(queue::restore);
            publisher
                    .compacted(Topics.ALARMS)
                    .values()
                    .forEach(json -> queue.take(StateJson.read(json, Alarm.class), now));
            shown = publisher.all().size();
            queue.forgetMissing().forEach(this::store);
        }

        private void show() {
            List<CapturingPublisher.Written> all = publisher.all();
            for (; shown < all.size(); shown++) {
                CapturingPublisher.Written written = all.get(shown);
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
                    inFlight.add(post);
                    Optional.ofNullable(post.attempt()).ifPresent(this::store);
                }
                assertThat(inFlight.size()).as(label).isLessThanOrEqualTo(DeliveryQueue.MAX_IN_FLIGHT);
                assertThat(inFlight)
                        .as(label)
                        .extracting(post -> post.alarm().alarm())
                        .doesNotHaveDuplicates();
                if (!inFlight.isEmpty() && random.nextInt(4) > 0) {
                    DeliveryQueue.Post post = inFlight.remove(random.nextInt(inFlight.size()));
                    if (unavailable) {
                        queue.completed(post, Webhook.Answer.failed("503"), now).ifPresent(this::store);
                    } else {
                        receive(post);
                        queue.completed(post, new Webhook.Answer(Webhook.Outcome.ACCEPTED, null, null), now)
                                .ifPresent(this::store);
                    }
                }
            }
        }

        private void receive(DeliveryQueue.Post post) {
            String body = new String(post.alarm().toBytes(), java.nio.charset.StandardCharsets.UTF_8);
            assertThat(deliveries.merge(post.id(), body, (before, after) -> before))
                    .as(label + "one id, one content")
                    .isEqualTo(body);
            Alarm before = received.put(post.alarm().alarm(), post.alarm());
            assertThat(before == null || before.sequence() <= post.alarm().sequence())
                    .as(label + "nothing older after what is newer")
                    .isTrue();
        }

        private void check() {
            publisher.compacted(Topics.ALARMS).values().forEach(json -> {
                Alarm alarm = StateJson.read(json, Alarm.class);
                Alarm existing = received.get(alarm.alarm());
                boolean suppressed = alarm.isMuted(now) || alarm.inhibitedBy() != null;
                if (alarm.state() == AlarmState.CLOSED) {
                    boolean closedUndelivered =
                            existing == null && (suppressed || alarm.handling().mutedUntil() != null);
                    assertThat(closedUndelivered || existing != null && existing.state() == AlarmState.CLOSED)
                            .as(label + alarm)
                            .isTrue();
                } else if (!suppressed) {
                    assertThat(existing).as(label + alarm).isNotNull();
                    assertThat(existing.sequence()).as(label + alarm).isEqualTo(alarm.sequence());
                }
            });
            assertThat(queue.waiting()).as(label).isZero();
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
