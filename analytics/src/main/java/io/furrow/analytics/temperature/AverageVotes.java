package io.furrow.analytics.temperature;

import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.flink.streaming.api.functions.windowing.ProcessWindowFunction;
import org.apache.flink.streaming.api.windowing.windows.TimeWindow;
import org.apache.flink.util.Collector;

/**
 * Computes a field's result from the votes of its devices.
 *
 * <p>State: the votes of each field and window. Cleared: with the window, when the watermark passes its end and the allowed
 * lateness. Late: a repeated vote replaces the device's earlier one, and the result is emitted again. Emits: one result per
 * field and window in which a device voted, when the watermark passes the end of the window.
 */
final class AverageVotes extends ProcessWindowFunction<DeviceVote, FieldAverage, String, TimeWindow> {
    private static final long serialVersionUID = 1L;

    private final double suspectFloor;

    AverageVotes(double suspectFloor) {
        this.suspectFloor = suspectFloor;
    }

    @Override
    public void process(String field, Context context, Iterable<DeviceVote> votes, Collector<FieldAverage> out) {
        Map<String, DeviceVote> latest = new HashMap<>();
        DeviceVote newest = null; // by the version of the field: whose domain counts
        for (DeviceVote vote : votes) {
            latest.put(vote.voter(), vote);
            newest = newest == null || vote.validFrom() > newest.validFrom() ? vote : newest;
        }
        Map<String, Double> values = new HashMap<>();
        latest.forEach((voter, vote) -> values.put(voter, vote.value()));
        RobustMean average = RobustMean.of(values, suspectFloor);
        List<DeviceVote> suspects = average.suspects().stream()
                .map(latest::get)
                .sorted(DeviceVote.NAMING)
                .toList();
        out.collect(new FieldAverage(
                newest.field(),
                newest.domain(),
                newest.scope(),
                newest.windowStart(),
                newest.windowEnd(),
                average.naming(suspects.stream().map(DeviceVote::device).toList()),
                suspects.stream().map(DeviceVote::type).toList()));
    }
}
