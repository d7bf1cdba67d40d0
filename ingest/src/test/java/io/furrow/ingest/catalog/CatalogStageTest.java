package io.furrow.ingest.catalog;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.api.java.typeutils.PojoTypeInfo;
import org.apache.flink.streaming.api.operators.KeyedProcessOperator;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

@SuppressWarnings("try") // closing a harness may be interrupted, which no test is
class CatalogStageTest {
    private static final long T = Reports.TIME;
    private static final Duration INTERVAL = Duration.ofSeconds(10);
    private static final Duration RETENTION = Duration.ofDays(30);

    @Test
    void addsUpAnEntityAndPassesItOnOncePerInterval() throws Exception {
        try (var harness = profiles()) {
            for (int i = 0; i < 5; i++) {
                harness.processElement(Reports.thermometer("t1", "m", T + i, i), T + i);
            }
            assertThat(harness.extractOutputValues()).isEmpty();

            harness.processWatermark(T + 10_000);

            assertThat(harness.extractOutputValues()).singleElement().satisfies(entry -> {
                assertThat(entry.events()).isEqualTo(5);
                assertThat(entry.entities()).isEqualTo(1);
                assertThat(entry.attributes().get("Temperature").max()).isEqualTo(4);
            });
            assertThat(harness.numEventTimeTimers()).as("its expiry").isOne();

            harness.processElement(Reports.thermometer("t1", "m", T + 11_000, 9), T + 11_000);
            harness.processWatermark(T + 20_000);
            assertThat(harness.extractOutputValues())
                    .hasSize(2)
                    .element(1)
                    .satisfies(entry -> assertThat(entry.entities()).isZero());
        }
    }

    @Test
    void countsAnEntityInEachMissionAndNoMoreAfterItsDeletion() throws Exception {
        try (var harness = profiles()) {
            harness.processElement(Reports.thermometer("t1", "weeding", T, 1), T);
            harness.processElement(Reports.thermometer("t1", "sowing", T + 1, 1), T + 1);
            harness.processElement(Reports.thermometer("t2", "sowing", T + 1, 1), T + 1);
            harness.processElement(Reports.of("t1", "", T + 2, null), T + 2);
            harness.processElement(Reports.of("t2", "", T + 2, null), T + 2);
            harness.processWatermark(T + 20_000);

            List<CatalogEntry> entries = harness.extractOutputValues();
            assertThat(sum(entries, "weeding").entities()).isZero();
            assertThat(sum(entries, "weeding").events()).isEqualTo(1);
            assertThat(sum(entries, "sowing").entities()).isZero();
            assertThat(sum(entries, "sowing").events()).isEqualTo(2);
            assertThat(harness.numKeyedStateEntries()).isZero();
            assertThat(harness.numEventTimeTimers()).isZero();
        }
    }

    /** Its entry has expired by then: an entity that is not counted again would make one of 0 entities. */
    @Test
    @Timeout(
            value = 60,
            threadMode = Timeout.ThreadMode.SEPARATE_THREAD) // an entry that stays fires its timer for ever
    void countsAnEntityAgainThatWasSilentForTheRetention() throws Exception {
        try (var harness = profiles()) {
            long later = T + Duration.ofDays(40).toMillis();
            harness.processElement(Reports.thermometer("t1", "m", T, 1), T);
            harness.processWatermark(T + 10_000);
            harness.processElement(Reports.thermometer("t1", "other", later, 1), later);
            harness.processWatermark(later + 10_000);
            assertThat(sum(harness.extractOutputValues(), "m").entities()).isZero();

            harness.processElement(Reports.thermometer("t1", "m", later + 11_000, 1), later + 11_000);
            harness.processWatermark(later + 20_000);
            assertThat(sum(harness.extractOutputValues(), "m").entities()).isOne();

            long end = later + 20_000 + RETENTION.toMillis();
            harness.processWatermark(end);
            assertThat(harness.numKeyedStateEntries()).isZero();
            assertThat(harness.numEventTimeTimers()).isZero();
        }
    }

    @Test
    void keepsTheExpiryOfAnEntryThatOnlyLosesEntities() throws Exception {
        try (var harness = merging()) {
            CatalogEntry one = CatalogEntry.of(Reports.thermometer("t", "m", T, 1));
            harness.processElement(one.andEntities(1), T);
            harness.processWatermark(T + 10_000);
            harness.processElement(one.onlyEntities(-1), T + RETENTION.toMillis());
            harness.processWatermark(T + 20_000 + RETENTION.toMillis());

            assertThat(harness.extractOutputValues())
                    .last()
                    .satisfies(record -> assertThat(record.value()).isNull());
            assertThat(harness.numKeyedStateEntries()).isZero();
            assertThat(harness.numEventTimeTimers()).isZero();
        }
    }

    @Test
    void mergesEntitiesToOneRecordPerInterval() throws Exception {
        try (var harness = merging()) {
            for (int i = 0; i < 100; i++) {
                CatalogEntry entry = CatalogEntry.of(Reports.thermometer("t" + i, "m", T + i, i));
                harness.processElement(entry.andEntities(1), T + i);
            }
            harness.processWatermark(T + 10_000);
            assertThat(harness.extractOutputValues()).singleElement().satisfies(record -> {
                assertThat(record.topic()).isEqualTo("data.catalog");
                assertThat(record.key()).asString().isEqualTo("farm|north|m|Thermometer");
                assertThat(record.timestamp()).isEqualTo(T + 99);
                assertThat(NgsiJson.read(record.value()).path("entities").asInt())
                        .isEqualTo(100);
            });
        }
    }

    @Test
    void removesAnEntryThatHasHadNoEventForTheRetention() throws Exception {
        try (var harness = merging()) {
            for (int day = 0; day < 3; day++) {
                long time = T + Duration.ofDays(20L * day).toMillis();
                harness.processElement(CatalogEntry.of(Reports.thermometer("t", "m", time, 1)), time);
                harness.processWatermark(time + 10_000);
            }
            assertThat(harness.extractOutputValues()).hasSize(3).noneMatch(record -> record.value() == null);
            assertThat(harness.numEventTimeTimers())
                    .as("one, however often it was written")
                    .isEqualTo(1);

            harness.processWatermark(T + Duration.ofDays(71).toMillis());

            assertThat(harness.extractOutputValues()).hasSize(4).last().satisfies(record -> {
                assertThat(record.key()).asString().isEqualTo("farm|north|m|Thermometer");
                assertThat(record.value()).isNull();
            });
            assertThat(harness.numKeyedStateEntries()).isZero();
            assertThat(harness.numEventTimeTimers()).isZero();
        }
    }

    @Test
    void marksAnEntryWhoseLastEntityIsDeletedUntilAnEventComes() throws Exception {
        try (var harness = merging()) {
            CatalogEntry one = CatalogEntry.of(Reports.thermometer("t", "m", T, 1));
            harness.processElement(one.andEntities(1), T);
            harness.processElement(one.onlyEntities(-1), T + 5);
            harness.processWatermark(T + 10_000);
            harness.processElement(CatalogEntry.of(Reports.thermometer("t", "m", T + 11_000, 1)), T + 11_000);
            harness.processWatermark(T + 20_000);

            assertThat(harness.extractOutputValues())
                    .extracting(record ->
                            NgsiJson.read(record.value()).path("deleted").asText("none"))
                    .containsExactly("2023-11-14T22:13:20.005Z", "none");
        }
    }

    @Test
    void makesNoEntryOfADeletionAlone() throws Exception {
        try (var harness = merging()) {
            harness.processElement(
                    CatalogEntry.of(Reports.thermometer("t", "m", T, 1)).onlyEntities(-1), T);
            harness.processWatermark(T + 10_000);

            assertThat(harness.extractOutputValues()).isEmpty();
            assertThat(harness.numKeyedStateEntries()).isZero();
        }
    }

    @Test
    void keepsItsEntriesAtTheEndOfTheInput() throws Exception {
        try (var harness = merging()) {
            harness.processElement(CatalogEntry.of(Reports.thermometer("t", "m", T, 1)), T);
            harness.processWatermark(Long.MAX_VALUE - 1); // of the stream of devices, which holds nothing up
            harness.processWatermark(Long.MAX_VALUE);

            assertThat(harness.extractOutputValues())
                    .singleElement()
                    .satisfies(record -> assertThat(record.value()).isNotNull());
        }
    }

    @Test
    void keepsItsStateWithoutKryo() {
        for (Class<?> type : new Class<?>[] {CatalogEntry.class, AttributeProfile.class}) {
            assertThat(TypeInformation.of(type)).isInstanceOf(PojoTypeInfo.class);
        }
    }

    private static KeyedOneInputStreamOperatorTestHarness<String, ReportedEvent, CatalogEntry> profiles()
            throws Exception {
        var harness = new KeyedOneInputStreamOperatorTestHarness<String, ReportedEvent, CatalogEntry>(
                new KeyedProcessOperator<>(new ProfileEntities(INTERVAL, RETENTION)),
                ReportedEvent::identity,
                Types.STRING);
        harness.open();
        return harness;
    }

    private static KeyedOneInputStreamOperatorTestHarness<String, CatalogEntry, TopicRecord> merging()
            throws Exception {
        var harness = new KeyedOneInputStreamOperatorTestHarness<String, CatalogEntry, TopicRecord>(
                new KeyedProcessOperator<>(new MergeCatalog(INTERVAL, RETENTION)), CatalogEntry::key, Types.STRING);
        harness.open();
        return harness;
    }

    private static CatalogEntry sum(List<CatalogEntry> entries, String mission) {
        return new ArrayList<>(entries)
                .stream()
                        .filter(entry -> entry.mission().equals(mission))
                        .reduce(CatalogEntry::plus)
                        .orElseThrow();
    }
}
