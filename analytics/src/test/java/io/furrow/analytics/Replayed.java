package io.furrow.analytics;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

import org.apache.flink.api.common.eventtime.TimestampAssignerSupplier;
import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** A replay of a mission in four epochs, and what a job writes of each beside what it writes of that alone. */
public final class Replayed {
    public static final String TOPIC = "data.hoeing.replay.0a1b2c3d";

    private static final long A_WEEK = 7 * 86_400_000L;

    private Replayed() {}

    /** A job under test. */
    public interface Job {
        List<TopicRecord> run(List<TopicRecord> records) throws Exception;
    }

    /**
     * The whole mission; from a point on again, with where its devices were; the whole once more, to its end; and up to the point.
     * Timestamps never step back.
     *
     * @param arrivals as they came live
     */
    public static List<List<TopicRecord>> epochs(List<TopicRecord> arrivals, long point) {
        List<TopicRecord> before =
                arrivals.stream().filter(live -> live.timestamp() <= point).toList();
        List<TopicRecord> after =
                arrivals.stream().filter(live -> live.timestamp() > point).toList();
        Map<String, TopicRecord> newest = new TreeMap<>();
        for (TopicRecord live : before) {
            newest.merge(text(live.key()), live, (a, b) -> a.timestamp() > b.timestamp() ? a : b);
        }
        List<TopicRecord> again = new ArrayList<>();
        newest.values().forEach(live -> again.add(record(at(point, live), 1, A_WEEK, "prime")));
        after.forEach(live -> again.add(record(live, 1, A_WEEK, "event")));
        List<TopicRecord> whole = new ArrayList<>(events(arrivals, 2));
        whole.add(record(at(after.get(after.size() - 1).timestamp(), arrivals.get(0)), 2, 2 * A_WEEK, "end"));
        return List.of(events(arrivals, 0), again, whole, events(before, 3));
    }

    private static List<TopicRecord> events(List<TopicRecord> arrivals, int epoch) {
        return arrivals.stream()
                .map(live -> record(live, epoch, epoch * A_WEEK, "event"))
                .toList();
    }

    private static TopicRecord at(long time, TopicRecord live) {
        return new TopicRecord(live.topic(), 0, 7, time, live.key(), live.value(), live.headers());
    }

    /** Each epoch of a replay gives what it gives alone, and nothing is late or unreadable. */
    public static void assertThatEpochsAreAsAlone(List<List<TopicRecord>> epochs, Job job) throws Exception {
        List<TopicRecord> all = job.run(epochs.stream().flatMap(List::stream).toList());
        assertThat(all)
                .extracting(TopicRecord::topic)
                .noneMatch(topic -> topic.endsWith("late") || topic.endsWith("dead"));
        for (int epoch = 0; epoch < epochs.size(); epoch++) {
            List<TopicRecord> alone = job.run(epochs.get(epoch).stream()
                    .map(record -> record.with(HeaderNames.REPLAY_EPOCH, "0"))
                    .toList());
            assertThat(ofEpoch(alone, 0)).as("epoch %d alone", epoch).isNotEmpty();
            assertThat(ofEpoch(all, epoch)).as("epoch %d", epoch).isEqualTo(ofEpoch(alone, 0));
        }
        assertThat(all.stream().map(record -> record.headers().get(HeaderNames.CE_ID)))
                .as("results of two epochs are two")
                .doesNotHaveDuplicates();
    }

    /**
     * What was reported then, as the replay tells it.
     *
     * @param offset ms that its timestamp is ahead
     * @param kind {@code event}, {@code prime} or {@code end}
     */
    public static TopicRecord record(TopicRecord live, int epoch, long offset, String kind) {
        var stamped = new TopicRecord(TOPIC, 0, 7, live.timestamp() + offset, live.key(), live.value(), live.headers());
        return stamped.with(Map.of(
                HeaderNames.REPLAY_EPOCH,
                Integer.toString(epoch),
                HeaderNames.REPLAY_OFFSET,
                Long.toString(offset),
                HeaderNames.REPLAY_KIND,
                kind,
                HeaderNames.ORIGIN,
                "replay"));
    }

    /** Those of the job's own source, with a watermark after each record. Records of other topics only begin event time. */
    public static WatermarkStrategy<TopicRecord> watermarks(JobOptions options) {
        WatermarkStrategy<TopicRecord> own = KafkaConnectors.watermarks(options);
        TimestampAssignerSupplier<TopicRecord> timestamps = own::createTimestampAssigner;
        return WatermarkStrategy.<TopicRecord>forGenerator(
                        context -> new EachRecord(own.createWatermarkGenerator(context)))
                .withTimestampAssigner(timestamps);
    }

    private record EachRecord(WatermarkGenerator<TopicRecord> own) implements WatermarkGenerator<TopicRecord> {
        @Override
        public void onEvent(TopicRecord record, long timestamp, WatermarkOutput output) {
            if (Topics.isReplay(record.topic())) {
                own.onEvent(record, timestamp, output);
                own.onPeriodicEmit(output);
            } else {
                output.emitWatermark(new Watermark(timestamp));
            }
        }

        @Override
        public void onPeriodicEmit(WatermarkOutput output) {}
    }

    /** What was written of an epoch, in a line each, in order, without what tells epochs apart. */
    public static List<String> ofEpoch(List<TopicRecord> written, int epoch) {
        return written.stream()
                .filter(record ->
                        Integer.toString(epoch).equals(record.headers().get(HeaderNames.REPLAY_EPOCH)))
                .map(record -> record.topic() + " " + record.timestamp() + " " + text(record.key()) + " "
                        + text(record.value()).replaceAll("([0-9]{13}):[0-9]+", "$1"))
                .sorted()
                .toList();
    }

    private static String text(byte[] bytes) {
        return new String(bytes, UTF_8);
    }
}
