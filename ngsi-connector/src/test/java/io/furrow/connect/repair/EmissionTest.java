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

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class EmissionTest {
    private static final Instant T = Instant.parse("2026-11-21T12:00:00Z");

    @TempDir
    private Path folder;

    private final LiveEvents live = new LiveEvents();
    private final List<String> emitted = new ArrayList<>();
    private KnownEntities known;
    private int refusals;

    @BeforeEach
    void open() throws Exception {
        known = KnownEntities.open(folder.resolve("known"), 1000);
        live.watch();
    }

    @Test
    void passesOverWhatCameByNotificationSinceItWasAskedFor() throws Exception {
        live.handOn(List.of(identity("before")), () -> null);
        long asked = System.nanoTime();
        live.handOn(List.of(identity("since")), () -> null);

        int count = emission(new CompletableFuture<>()).emit(List.of(), asked);
        count += emission(CompletableFuture.completedFuture(null))
                .emit(List.of(finding("before"), finding("since"), finding("never")), asked);

        assertThat(count).isEqualTo(2);
        assertThat(emitted).containsExactly("before", "never");
        assertThat(known.copy()).containsExactlyInAnyOrder(identity("before"), identity("never"));
        assertThat(live.isSeen(finding("never").event().id())).isTrue();
        assertThat(live.isSeen(finding("since").event().id())).isFalse();
    }

    @Test
    void waitsForRoomAndTakesAFewAtATime() throws Exception {
        refusals = 3;
        List<Finding.Changed> many =
                IntStream.range(0, 250).mapToObj(i -> finding("e" + i)).toList();

        int count = emission(CompletableFuture.completedFuture(null)).emit(many, System.nanoTime());

        assertThat(count).isEqualTo(250);
        assertThat(emitted).hasSize(250).doesNotHaveDuplicates();
        assertThat(refusals).isZero();
    }

    @Test
    void forgetsNothingThatDidNotBecomeDurable() throws Exception {
        CompletableFuture<Void> failed = CompletableFuture.failedFuture(new IllegalStateException("the disk is gone"));

        assertThatThrownBy(() -> emission(failed).emit(List.of(finding("e")), System.nanoTime()))
                .isInstanceOf(java.io.IOException.class)
                .hasMessageContaining("the disk is gone");
        assertThat(live.isSeen(finding("e").event().id())).isFalse();
        assertThat(known.size()).isZero();
    }

    private Emission emission(CompletableFuture<Void> durable) {
        return new Emission(
                (subscription, findings) -> {
                    if (refusals > 0) {
                        refusals--;
                        return Optional.empty();
                    }
                    assertThat(findings).hasSizeLessThanOrEqualTo(100);
                    findings.forEach(finding -> emitted.add(Identities.id(finding.identity())));
                    return Optional.of(durable);
                },
                live,
                known,
                "s");
    }

    private static String identity(String id) {
        return FiwareScope.DEFAULT.identity(id);
    }

    private static Finding.Changed finding(String id) {
        Entity entity = Entity.builder(id, "Probe").build();
        return new Finding.Changed(
                EntityEvent.of(entity, FiwareScope.DEFAULT, T, EventTimeRule.within(Duration.ZERO), Origin.REPAIR));
    }
}
