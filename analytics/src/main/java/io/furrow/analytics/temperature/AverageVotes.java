package io.furrow.analytics.temperature;

import java.util.HashMap;
import java.util.Map;

import org.apache.flink.streaming.api.functions.windowing.WindowFunction;
import org.apache.flink.streaming.api.windowing.windows.TimeWindow;
import org.apache.flink.util.Collector;

import io.furrow.flink.ResultRecord;
import io.furrow.flink.TopicRecord;

/**
 * Makes a field's result of its devices' votes.
 *
 * <p>State: the votes of each field and window. Cleared: with the window, when the watermark passes its end and the allowed
 * lateness. Late: a vote cast again replaces the device's earlier one, and the result is sent again. Emits: one record per
 * field and window in which a device voted, when the watermark passes the end of the window; key = field id, timestamp = the
 * window's last instant.
 */
final class AverageVotes implements WindowFunction<DeviceVote, TopicRecord, String, TimeWindow> {
    private static final long serialVersionUID = 1L;
    private static final String SOURCE = "/analytics/temperature";

    private final String topic;
    private final double madFloor;

    AverageVotes(String topic, double madFloor) {
        this.topic = topic;
        this.madFloor = madFloor;
    }

    @Override
    public void apply(String field, TimeWindow window, Iterable<DeviceVote> votes, Collector<TopicRecord> out) {
        Map<String, Double> latest = new HashMap<>();
        DeviceVote newest = null; // by the version of the field: whose domain counts
        for (DeviceVote vote : votes) {
            latest.put(vote.device(), vote.value());
            newest = newest == null || vote.validFrom() > newest.validFrom() ? vote : newest;
        }
        FieldTemperature result = new FieldTemperature(
                newest.field(),
                newest.domain(),
                newest.windowStart(),
                newest.windowEnd(),
                RobustMean.of(latest, madFloor));
        out.collect(
                ResultRecord.of(topic, result.field(), result.entity(), newest.scope(), result.timestamp(), SOURCE));
    }
}
