package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

import jdk.jfr.Recording;
import jdk.jfr.consumer.RecordedEvent;
import jdk.jfr.consumer.RecordingFile;
import org.assertj.core.api.InstanceOfAssertFactories;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.broker.BrokerException;
import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.repair.ModelSource.Bounds;
import io.furrow.connect.repair.ModelSource.Topic;

import static org.assertj.core.api.Assertions.as;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class SubscriptionReconcilerTest {
    private static final Bounds BOUNDS = new Bounds(10, 5000, 1 << 20, Duration.ofHours(1));

    @TempDir
    private Path folder;

    private final ModelBroker broker = new ModelBroker(true, () -> {});
    private final Topic topic = new Topic();
    private final List<String> asked = new ArrayList<>();

    private ModelSource source() throws IOException {
        return new ModelSource(this::answer, broker::nanos, folder, BOUNDS, topic);
    }

    private Outcome answer(BrokerRequest request) {
        asked.add(request.path());
        return broker.apply(request);
    }

    @Test
    void listsAllIdsAfterAStartAndNotAtEachGap() throws Exception {
        try (ModelSource source = source()) {
            for (int i = 0; i < 5; i++) {
                broker.put("e" + i, "Probe", "v");
                broker.queue.clear();
                broker.pass(1000);
                source.look();
                source.look();
            }

            assertThat(source.ledger().gaps.sum()).isEqualTo(4);
        }
        assertThat(asked)
                .filteredOn(path -> path.contains("orderBy=dateCreated"))
                .hasSize(1);
        assertThat(topic.values()).hasSize(5);
    }

    @Test
    void asksForWhatTheContextBrokerItselfHolds() throws Exception {
        try (ModelSource source = source()) {
            broker.put("e", "Probe", "v");
            source.look();
            broker.delete("e Probe");
            broker.queue.clear();
            source.look();
        }

        assertThat(asked)
                .filteredOn(path -> path.startsWith("/v2/entities"))
                .hasSizeGreaterThan(1)
                .allMatch(path -> path.contains("options=skipForwarding"));
    }

    @Test
    void readsWhatMayBeMissingAfterALookThatFailed() throws Exception {
        try (ModelSource source = source()) {
            source.look();
            source.look();
            broker.away(true);
            assertThatThrownBy(source::look).isInstanceOf(BrokerException.class);
            broker.away(false);
            asked.clear();

            source.look();

            assertThat(source.ledger().gaps.sum()).isOne();
            assertThat(asked).anyMatch(path -> path.contains("orderBy=dateModified"));
        }
    }

    /** After a power cut the watermark must not be newer than the marks of entities that have to be read again. */
    @Test
    void syncsItsEntitiesBeforeTheWatermark() throws Exception {
        Path events = folder.resolve("events.jfr");
        try (Recording forced = new Recording()) {
            forced.enable("jdk.FileForce").withoutThreshold();
            forced.start();
            try (ModelSource source = source()) {
                broker.put("e", "Probe", "v");
                source.look();
                source.look();
            }
            forced.stop();
            forced.dump(events);
        }

        assertThat(RecordingFile.readAllEvents(events).stream()
                        .sorted(Comparator.comparing(RecordedEvent::getStartTime))
                        .map(event ->
                                Path.of(event.getString("path")).getFileName().toString()))
                .containsSubsequence("known.tmp", "known", "watermark.tmp")
                .containsOnlyOnce("known")
                .last(as(InstanceOfAssertFactories.STRING))
                .as("the folder with the name of the watermark")
                .startsWith("agri@");
    }

    /** Neither the queue nor the counters show it: what was lost had not been counted for good. */
    @Test
    void readsWhatARestartOfTheContextBrokerLost() throws Exception {
        try (ModelSource source = source()) {
            source.look();
            source.look();
            broker.pass(10_000);
            broker.put("e", "Probe", "lost");
            broker.restart();
            broker.pass(10_000);

            source.look();
        }

        assertThat(topic.values()).containsEntry("e Probe", "lost");
    }

    @Test
    void repairsTheOthersWhereOneEntityIsTooLarge() throws Exception {
        broker.put("a", "Probe", "v1");
        broker.pass(1);
        broker.put("b", "Probe", "x".repeat(6000));
        broker.pass(1);
        broker.put("c", "Probe", "v2");
        try (ModelSource source = source()) {
            source.look();
        }

        assertThat(topic.values()).containsOnlyKeys("a Probe", "c Probe");
        assertThat(topic.unreadable()).containsOnlyKeys("b Probe");
    }

    /** The later one was lost, the earlier one comes when the later was read. */
    @Test
    void emitsTheNewestStateAgainAfterAnOlderOneThatComesLate() throws Exception {
        try (ModelSource source = source()) {
            source.look();
            broker.put("e", "Probe", "older");
            broker.pass(5);
            broker.put("e", "Probe", "newer");
            broker.queue.remove(1);
            source.look();
            source.look();
            assertThat(topic.values()).containsEntry("e Probe", "newer");

            source.take(broker.queue.remove(0));
            assertThat(topic.values()).containsEntry("e Probe", "older");
            source.look();
        }

        assertThat(topic.values()).containsEntry("e Probe", "newer");
    }

    /** It would stand for the one that was lost after the repair. */
    @Test
    void countsNoLateChangeOfAnEntityThatARepairFoundDeleted() throws Exception {
        Bounds bounds = new Bounds(10, 5000, 1 << 20, Duration.ZERO);
        try (ModelSource source = new ModelSource(broker, broker::nanos, folder, bounds, topic)) {
            source.look();
            broker.put("deleted", "Probe", "v1");
            source.take(broker.queue.remove(0));
            source.look();
            broker.pass(1);
            broker.put("deleted", "Probe", "v2");
            broker.delete("deleted Probe");
            broker.queue.remove(1);
            broker.failed();
            source.look();
            assertThat(topic.gone()).containsEntry("deleted Probe", true);

            broker.put("lost", "Probe", "v");
            broker.queue.remove(1);
            source.take(broker.queue.remove(0));
            source.look();
            source.look();
        }

        assertThat(topic.values()).containsOnlyKeys("lost Probe");
    }

    /** The states to read again are older than the time up to which the books are balanced. */
    @Test
    void emitsTheNewestStatesAgainAfterMoreThatComeLateThanAreTrackedAlsoAcrossARestart() throws Exception {
        Bounds bounds = new Bounds(10, 5000, 700, Duration.ofHours(1));
        List<ModelBroker.Told> older = new ArrayList<>();
        try (ModelSource source = new ModelSource(broker, broker::nanos, folder, bounds, topic)) {
            source.look();
            for (int i = 0; i < 5; i++) {
                broker.put("e" + i, "Probe", "older");
                broker.pass(5);
                broker.put("e" + i, "Probe", "newer");
                older.add(broker.queue.get(0));
                source.take(broker.queue.remove(0));
                source.take(broker.queue.remove(0));
            }
            broker.pass(60_000);
            source.look();
            source.look();
            assertThat(topic.values()).hasSize(5).containsValue("newer").doesNotContainValue("older");

            older.forEach(source::take);
            assertThat(topic.values()).doesNotContainValue("newer");
        }
        try (ModelSource source = new ModelSource(broker, broker::nanos, folder, bounds, topic)) {
            source.look();
            assertThat(topic.values()).hasSize(5).doesNotContainValue("older");

            older.forEach(source::take);
            assertThat(topic.values()).doesNotContainValue("newer");
            source.look();
        }

        assertThat(topic.values()).hasSize(5).doesNotContainValue("older");
    }

    /** Without the volume of its database a context broker lists nothing. */
    @Test
    void deletesMostEntitiesOnlyOnceASecondListingAgreesAndReadsThemAgainWhenTheyAreBack() throws Exception {
        put(8);
        try (ModelSource source = source()) {
            source.look();
            broker.pass(3_600_000);
            broker.unmount();

            source.look();
            broker.pass(59_000);
            source.look();
            assertThat(topic.values()).hasSize(8);
            assertThat(source.unconfirmed()).contains("8 of 8 known entities", "'agri' at /#", "mounted");

            broker.pass(1000);
            source.look();
            assertThat(topic.values()).isEmpty();
            assertThat(source.unconfirmed()).isEmpty();

            broker.pass(3_600_000);
            broker.mount();
            source.look();
            source.look();
        }

        assertThat(topic.values()).hasSize(8);
    }

    @Test
    void deletesNothingIfTheSecondListingHasTheEntities() throws Exception {
        put(8);
        try (ModelSource source = source()) {
            source.look();
            broker.pass(3_600_000);
            broker.unmount();
            source.look();
            broker.mount();
            broker.pass(60_000);
            broker.delete("e7 Probe");
            broker.queue.clear();
            source.look();

            assertThat(topic.gone()).containsEntry("e7 Probe", true);
            assertThat(source.unconfirmed()).isEmpty();
        }
        assertThat(topic.values()).hasSize(7);
    }

    /** While the volume is not mounted, a device makes its entity again. */
    @Test
    void readsAllEntitiesAgainOnceTheDatabaseIsAnother() throws Exception {
        put(8);
        try (ModelSource source = source()) {
            source.look();
            broker.pass(3_600_000);
            source.look();
            broker.unmount();
            source.look();
            broker.put("e1", "Probe", "made again");
            broker.pass(1000);
            broker.queue.forEach(source::take);
            assertThat(topic.values()).containsEntry("e1 Probe", "made again");
        }
        broker.mount();

        try (ModelSource source = source()) {
            source.look();
        }

        assertThat(topic.values()).hasSize(8).containsEntry("e1 Probe", "v1");
    }

    /** Their times are long before the watermark. */
    @Test
    void readsTheEntitiesAgainThatItDeletedAlsoAfterARestart() throws Exception {
        put(3);
        try (ModelSource source = source()) {
            source.look();
            broker.pass(3_600_000);
            broker.unmount();
            source.look();
            assertThat(topic.values()).isEmpty();
        }
        broker.pass(3_600_000);
        broker.mount();

        try (ModelSource source = source()) {
            source.look();
            source.look();
        }

        assertThat(topic.values()).hasSize(3);
    }

    @Test
    void readsEachEntityOnceAtTheFirstListing() throws Exception {
        put(8);
        try (ModelSource source = source()) {
            source.look();
            source.look();
        }

        assertThat(topic.values()).hasSize(8);
        assertThat(asked).noneMatch(path -> path.contains("&id="));
    }

    @Test
    void readsAllEntitiesAgainIfMoreAreMarkedThanAreTracked() throws Exception {
        String everything = "q=dateModified%3E%3D1970-01-01";
        try (ModelSource source = source()) {
            source.look();
            asked.clear();
            mark(source, EntityIdSet.MAX_STALE);
            source.look();
            assertThat(asked).noneMatch(path -> path.contains(everything));

            mark(source, EntityIdSet.MAX_STALE + 1);
            source.look();
            assertThat(asked).anyMatch(path -> path.contains(everything));

            asked.clear();
            source.look();
            assertThat(asked).noneMatch(path -> path.contains(everything));
        }
    }

    private static void mark(ModelSource source, int entities) {
        for (int i = 0; i < entities; i++) {
            source.markStale("agri|/|Probe|e" + i);
        }
    }

    private void put(int entities) {
        for (int i = 0; i < entities; i++) {
            broker.put("e" + i, "Probe", "v" + i);
        }
        broker.pass(1000);
    }
}
