package io.furrow.soak.year;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import org.apache.kafka.common.TopicPartition;
import org.bson.Document;

import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;
import io.furrow.soak.year.Tap.Report;

/** Checks that each acknowledged report is on all topics and collections to which it belongs. */
final class Accounts {
    /** Records written this long before a power cut may be lost on a broker without replicas. */
    static final long UNSYNCED_MILLIS = 2_500;

    private final YearFarm farm;
    private final Map<TopicPartition, Long> read = new HashMap<>();
    private final Map<Report, Integer> raw = new HashMap<>();
    private final List<Long> cuts = new ArrayList<>();

    /** A mission of a day. @param begun start, epoch ms @param ended request to stop, epoch ms */
    record DayMission(String name, Set<String> devices, long begun, long ended) {
        boolean holds(Report report) {
            return devices.contains(report.entity()) && report.time() >= begun && report.time() < ended;
        }
    }

    /**
     * The period of a check.
     *
     * @param once whether nothing was killed; otherwise jobs with at-least-once delivery repeat some records
     */
    record Span(String when, long from, long until, boolean once) {}

    Accounts(YearFarm farm) {
        this.farm = farm;
    }

    void addPowerCut(long time) {
        cuts.add(time);
    }

    /** Checks the reports acknowledged in the period; records that retention deletes have been read before. */
    List<YearCheck> check(Span span, List<DayMission> missions) throws UnreadableException {
        try (ReportLog log = new ReportLog(farm.up.kafka())) {
            List<Report> acknowledged = farm.tap.acknowledged().entrySet().stream()
                    .filter(each -> each.getValue() >= span.from() && each.getValue() < span.until())
                    .map(Map.Entry::getKey)
                    .toList();
            log.readNew(Topics.RAW, read, raw);
            List<YearCheck> checks = new ArrayList<>();
            checks.add(new YearCheck(
                    "acknowledged reports on data.raw, " + span.when(),
                    "%d reports, %d of them repeated"
                            .formatted(
                                    acknowledged.size(),
                                    acknowledged.stream()
                                            .filter(this::isRepeated)
                                            .count()),
                    acknowledged.stream()
                            .filter(each -> !raw.containsKey(each))
                            .map(Report::toString)
                            .toList()));
            checks.addAll(onMissions(log, span, missions, acknowledged));
            return checks;
        }
    }

    private List<YearCheck> onMissions(ReportLog log, Span span, List<DayMission> missions, List<Report> acknowledged)
            throws UnreadableException {
        List<String> onTopics = new ArrayList<>();
        List<String> inMongo = new ArrayList<>();
        int expected = 0;
        int unsynced = 0;
        var topics = log.all(missions.stream().map(Accounts::topic).toList());
        try (MongoClient mongo = MongoClients.create(farm.mongo())) {
            for (DayMission mission : missions) {
                Map<Report, Integer> topic = topics.get(topic(mission));
                Map<Report, Integer> documents = documents(mongo, mission.name());
                for (Report report : acknowledged) {
                    if (mission.holds(report)) {
                        expected++;
                        if (!topic.containsKey(report) && isUnsynced(report.time())) {
                            unsynced++;
                        } else if (topic.getOrDefault(report, 0) == 0 || span.once() && topic.get(report) > 1) {
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
        return List.of(
                new YearCheck(
                        "reports on their missions' topics, " + span.when(),
                        "%d reports of %d missions, each %s; %d of the last second before a power cut are missing"
                                .formatted(expected, missions.size(), span.once() ? "once" : "there", unsynced),
                        onTopics),
                new YearCheck(
                        "reports in MongoDB, " + span.when(), "%d reports, each once".formatted(expected), inMongo));
    }

    private static String topic(DayMission mission) {
        return Topics.realtime(FarmYear.DOMAIN, mission.name());
    }

    private static Map<Report, Integer> documents(MongoClient mongo, String mission) {
        Map<Report, Integer> documents = new HashMap<>();
        for (Document document : mongo.getDatabase(MongoAccess.DATABASE)
                .getCollection(MissionCollections.nameOf(mission))
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
        return documents;
    }

    private boolean isUnsynced(long time) {
        return isBeforeCut(time, UNSYNCED_MILLIS);
    }

    /** Whether the power was cut within {@code millis} after this time. */
    boolean isBeforeCut(long time, long millis) {
        return cuts.stream().anyMatch(cut -> time > cut - millis && time <= cut);
    }

    /** Whether the report was stored, also if its acknowledgment was lost. */
    boolean isStored(Report report) {
        return farm.tap.acknowledged().containsKey(report) || raw.containsKey(report);
    }

    boolean isRepeated(Report report) {
        return raw.getOrDefault(report, 0) > 1;
    }

    /** Drops reports that were acknowledged before. */
    void drop(long until) {
        raw.keySet().removeIf(each -> farm.tap.acknowledged().getOrDefault(each, Long.MAX_VALUE) < until);
    }
}
