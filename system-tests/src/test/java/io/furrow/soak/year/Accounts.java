package io.furrow.soak.year;

import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.TreeSet;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.bson.Document;

import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;
import io.furrow.soak.TopicLog;
import io.furrow.soak.devices.Encounters;
import io.furrow.soak.devices.ProgramEvent;
import io.furrow.soak.devices.Verdicts;
import io.furrow.soak.year.Tap.Report;

/** Looks for each acknowledged report where it belongs, and for the encounters that the tractors had. */
final class Accounts {
    /** What jobs had written this long before a power cut may be missing on a broker without replicas. */
    private static final long UNSYNCED_MILLIS = 2_500;

    private static final Duration QUIET = Duration.ofMillis(300);

    private final YearFarm farm;
    private final Fleet fleet;
    private final Verdicts verdicts;
    private final Map<TopicPartition, Long> read = new HashMap<>();
    private final Map<Report, Integer> raw = new HashMap<>();
    private final List<Long> cuts = new ArrayList<>();
    private long from;

    /** A mission of a day. @param begun when it ran, epoch ms @param ended when it was asked to stop, epoch ms */
    record DayMission(String name, Set<String> devices, long begun, long ended) {
        boolean holds(Report report) {
            return devices.contains(report.entity()) && report.time() >= begun && report.time() < ended;
        }
    }

    Accounts(YearFarm farm, Fleet fleet, Verdicts verdicts) {
        this.farm = farm;
        this.fleet = fleet;
        this.verdicts = verdicts;
        this.from = System.currentTimeMillis();
    }

    void powerWasCut(long time) {
        cuts.add(time);
    }

    /**
     * Of what was acknowledged since the last time.
     *
     * @param once whether nothing was killed, after which jobs that deliver at least once write some records again
     */
    void settle(String when, List<DayMission> missions, long until, boolean once) throws UnreadableException {
        List<Report> acknowledged = farm.tap().acknowledged().entrySet().stream()
                .filter(each -> each.getValue() >= from && each.getValue() < until)
                .map(Map.Entry::getKey)
                .toList();
        readRaw();
        verdicts.add(
                "acknowledged reports on data.raw, " + when,
                "%d reports, %d of them repeated"
                        .formatted(
                                acknowledged.size(),
                                acknowledged.stream()
                                        .filter(each -> raw.getOrDefault(each, 0) > 1)
                                        .count()),
                acknowledged.stream()
                        .filter(each -> !raw.containsKey(each))
                        .map(Report::toString)
                        .toList());
        onMissions(when, missions, acknowledged, once);
        encounters(when, until);
        acknowledged.forEach(raw::remove);
        from = until;
    }

    private void readRaw() throws UnreadableException {
        try (KafkaConsumer<byte[], byte[]> consumer = consumer()) {
            List<TopicPartition> partitions = partitions(consumer, Topics.RAW);
            consumer.assign(partitions);
            Map<TopicPartition, Long> begins = consumer.beginningOffsets(partitions);
            partitions.forEach(each -> consumer.seek(each, Math.max(begins.get(each), read.getOrDefault(each, 0L))));
            drain(consumer, raw);
            partitions.forEach(each -> read.put(each, consumer.position(each)));
        }
    }

    private static void drain(KafkaConsumer<byte[], byte[]> consumer, Map<Report, Integer> into)
            throws UnreadableException {
        Map<TopicPartition, Long> ends = consumer.endOffsets(consumer.assignment());
        while (ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue())) {
            for (ConsumerRecord<byte[], byte[]> record : consumer.poll(Duration.ofMillis(100))) {
                Report report = record.value() == null
                        ? null
                        : Report.of(Entity.parse(record.value()).json());
                if (report != null && report.time() > 0) { // of a device
                    into.merge(report, 1, Integer::sum);
                }
            }
        }
    }

    private void onMissions(String when, List<DayMission> missions, List<Report> acknowledged, boolean once)
            throws UnreadableException {
        List<String> onTopics = new ArrayList<>();
        List<String> inMongo = new ArrayList<>();
        int expected = 0;
        int unsynced = 0;
        try (KafkaConsumer<byte[], byte[]> consumer = consumer();
                MongoClient mongo = MongoClients.create(farm.mongo())) {
            for (DayMission mission : missions) {
                Map<Report, Integer> topic = new HashMap<>();
                consumer.assign(partitions(consumer, Topics.realtime(FarmYear.DOMAIN, mission.name())));
                consumer.seekToBeginning(consumer.assignment());
                drain(consumer, topic);
                Map<Report, Integer> documents = new HashMap<>();
                for (Document document : mongo.getDatabase(MongoAccess.DATABASE)
                        .getCollection(MissionCollections.nameOf(mission.name()))
                        .find()) {
                    Document time = document.get("Time", Document.class);
                    if (time != null) {
                        documents.merge(
                                new Report(
                                        document.getString("id"),
                                        time.get("value", Number.class).longValue()),
                                1,
                                Integer::sum);
                    }
                }
                for (Report report : acknowledged) {
                    if (mission.holds(report)) {
                        expected++;
                        if (!topic.containsKey(report) && isUnsynced(report)) {
                            unsynced++;
                        } else if (topic.getOrDefault(report, 0) == 0 || once && topic.get(report) > 1) {
                            onTopics.add("%d times on the topic of %s: %s"
                                    .formatted(topic.getOrDefault(report, 0), mission.name(), report));
                        }
                        if (documents.getOrDefault(report, 0) != 1) {
                            inMongo.add("%d times in MongoDB: %s of %s"
                                    .formatted(documents.getOrDefault(report, 0), report, mission.name()));
                        }
                    }
                }
            }
        }
        verdicts.add(
                "reports on their missions' topics, " + when,
                "%d reports of %d missions, each %s; %d of the last second before a power cut are missing"
                        .formatted(expected, missions.size(), once ? "once" : "there", unsynced),
                onTopics);
        verdicts.add("reports in MongoDB, " + when, "%d reports, each once".formatted(expected), inMongo);
    }

    private boolean isUnsynced(Report report) {
        return cuts.stream().anyMatch(cut -> report.time() > cut - UNSYNCED_MILLIS && report.time() <= cut);
    }

    private void encounters(String when, long until) throws UnreadableException {
        Set<Report> late = new HashSet<>();
        List<Entity> results;
        try (TopicLog log = new TopicLog(farm.up().kafka(), Topics.COLLISION_LATE)) {
            log.read(QUIET).forEach(each -> late.add(Report.of(each.json())));
        }
        try (TopicLog log = new TopicLog(farm.up().kafka(), Topics.COLLISION)) {
            results = log.read(QUIET);
        }
        List<ProgramEvent> told = fleet.tractors().entrySet().stream()
                .filter(each -> isTaken(each.getKey()) && !late.contains(each.getKey()))
                .map(Map.Entry::getValue)
                .sorted(java.util.Comparator.comparingLong(ProgramEvent::time))
                .toList();
        Set<String> expected = Encounters.expected(told, from, until - UNSYNCED_MILLIS);
        Set<String> found = Encounters.found(results, from, until - UNSYNCED_MILLIS);
        Set<String> differences = new TreeSet<>();
        expected.stream().filter(each -> !found.contains(each)).forEach(each -> differences.add("missing: " + each));
        found.stream().filter(each -> !expected.contains(each)).forEach(each -> differences.add("too many: " + each));
        verdicts.add("encounters, " + when, expected.size() + " encounters", List.copyOf(differences));
    }

    /** Also what was stored when the answer to it was lost. */
    private boolean isTaken(Report report) {
        return farm.tap().acknowledged().containsKey(report) || raw.containsKey(report);
    }

    private KafkaConsumer<byte[], byte[]> consumer() {
        Properties kafka = new Properties();
        kafka.setProperty("bootstrap.servers", farm.up().kafka());
        kafka.setProperty("isolation.level", "read_committed");
        kafka.setProperty("auto.offset.reset", "earliest");
        kafka.setProperty("enable.auto.commit", "false");
        kafka.setProperty("allow.auto.create.topics", "false");
        return new KafkaConsumer<>(kafka, new ByteArrayDeserializer(), new ByteArrayDeserializer());
    }

    private static List<TopicPartition> partitions(KafkaConsumer<?, ?> consumer, String topic) {
        return consumer.partitionsFor(topic).stream()
                .map(each -> new TopicPartition(topic, each.partition()))
                .toList();
    }
}
