package io.furrow.connect.repair;

import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.stream.IntStream;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class RepairPublisherTest {
    private static final Instant T = Instant.parse("2026-11-21T12:00:00Z");

    private final RecordTracker live = new RecordTracker(1 << 20);
    private final List<String> emitted = new ArrayList<>();
    private EntityIdSet known;
    private int refusals;

    @BeforeEach
    void open(@TempDir Path folder) throws Exception {
        known = EntityIdSet.open(folder.resolve("known"), 1 << 20);
    }

    @Test
    void passesOverWhatANotificationToldThatIsAsNewOrNewer() throws Exception {
        notify("same", "v", T);
        long asked = live.now();
        notify("newer", "later", T.plusMillis(1));
        notify("older", "earlier", T.minusMillis(1));

        int count = emission(CompletableFuture.completedFuture(null))
                .emit(List.of(finding("same"), finding("newer"), finding("older"), finding("never")), asked);

        assertThat(count).isEqualTo(2);
        assertThat(emitted).containsExactly("older", "never");
        assertThat(known.copy())
                .containsExactlyInAnyOrder(identity("same"), identity("newer"), identity("older"), identity("never"));
        assertThat(live.stale()).isEmpty();
    }

    @Test
    void asksAgainWhereItCannotTellWhichIsNewer() throws Exception {
        long asked = live.now();
        append("e", "event", Optional.empty());

        assertThat(emission(CompletableFuture.completedFuture(null)).emit(List.of(finding("e")), asked))
                .isZero();
        assertThat(live.stale()).containsExactly(identity("e"));

        assertThat(emission(CompletableFuture.completedFuture(null)).emit(List.of(finding("e")), live.now()))
                .isOne();
        assertThat(live.stale()).isEmpty();
    }

    /** Off, on, off under one time of the device: the first and the last have one event id. */
    @Test
    void emitsAStateThatCameBackThoughItsEventWasThereBefore() throws Exception {
        notify("e", "v", T.minusMillis(2));
        notify("e", "other", T.minusMillis(1));

        assertThat(emission(CompletableFuture.completedFuture(null)).emit(List.of(finding("e")), live.now()))
                .isOne();
    }

    @Test
    void waitsForRoomAndTakesAFewAtATime() throws Exception {
        refusals = 3;
        List<MissedChange.Changed> many =
                IntStream.range(0, 250).mapToObj(i -> finding("e" + i)).toList();

        int count = emission(CompletableFuture.completedFuture(null)).emit(many, live.now());

        assertThat(count).isEqualTo(250);
        assertThat(emitted).hasSize(250).doesNotHaveDuplicates();
        assertThat(refusals).isZero();
    }

    @Test
    void readsAgainWhatDidNotBecomeDurable() throws Exception {
        CompletableFuture<Void> failed = CompletableFuture.failedFuture(new IllegalStateException("the disk is gone"));

        assertThatThrownBy(() -> emission(failed).emit(List.of(finding("e")), live.now()))
                .isInstanceOf(java.io.IOException.class)
                .hasMessageContaining("the disk is gone");
        assertThat(live.stale()).containsExactly(identity("e"));
        assertThat(live.isNews(finding("e").record(), live.now())).isTrue();
        assertThat(known.size()).isZero();
    }

    private RepairPublisher emission(CompletableFuture<Void> durable) {
        RepairOutput output = new RepairOutput() {
            @Override
            public byte[] serialize(String subscription, MissedChange finding) {
                assertThat(Thread.holdsLock(live)).isFalse();
                return EntityKeys.id(finding.identity()).getBytes(UTF_8);
            }

            @Override
            public Optional<CompletableFuture<Void>> append(List<byte[]> records) {
                if (refusals > 0) {
                    refusals--;
                    return Optional.empty();
                }
                assertThat(records).hasSizeLessThanOrEqualTo(100);
                records.forEach(record -> emitted.add(new String(record, UTF_8)));
                return Optional.of(durable);
            }
        };
        return new RepairPublisher(output, live, known, "s");
    }

    private void notify(String id, String value, Instant modified) {
        append(id, event(id, value).id(), Optional.of(modified));
    }

    private void append(String id, String eventId, Optional<Instant> modified) {
        live.append(
                "s",
                List.of(new TrackedRecord(identity(id), eventId, modified, false)),
                () -> Optional.of(CompletableFuture.completedFuture(null)));
    }

    private static String identity(String id) {
        return FiwareScope.DEFAULT.identity("Probe", id);
    }

    private static MissedChange.Changed finding(String id) {
        return MissedChange.Changed.of(event(id, "v"), T);
    }

    private static EntityEvent event(String id, String value) {
        Entity entity = Entity.builder(id, "Probe").text("state", value).build();
        return EntityEvent.of(entity, FiwareScope.DEFAULT, T, EventTimeRule.within(Duration.ZERO), Origin.REPAIR);
    }
}
