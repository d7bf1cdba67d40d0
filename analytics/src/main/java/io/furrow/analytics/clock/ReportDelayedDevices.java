package io.furrow.analytics.clock;

import java.time.Duration;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Reports devices of any kind with a streak of records that are behind their {@link ReceiptTime} by more than a limit, independently of
 * watermarks. A record on time ends the streak. An older record than the last is ignored, and so is one of the same time, unless it was
 * received later and has other measurements: then the clock stands still. All records of a device pass through the same subtask.
 *
 * <p><b>State</b>: in memory only; streaks begin again after a restart.
 *
 * <p><b>Late</b>: no record.
 *
 * <p><b>Emits</b>: that the device is delayed, and at most once a minute that it still is. Replayed and repaired records do not count, nor does
 * a backlog, which a gateway sends faster than it came about.
 */
final class ReportDelayedDevices extends ProcessFunction<TopicRecord, ClockReport> {
    private static final long serialVersionUID = 1L;
    /** Two wrong times are tolerated, as in a clock's offset. */
    private static final int MIN_RECORDS = 3;

    private static final int MAX_DEVICES = 10_000;
    private static final int MAX_TYPES = 10;
    private static final int CATCHES_UP = 2;
    /** Attributes that others than the device write, beside commands. */
    private static final Pattern NOT_MEASURED = Pattern.compile("TimeInstant|Domain|Mission");

    private final ReceiptTime receiptTime;
    private final long maxBehindMillis;
    /** By type, for entities of one id. */
    private transient Map<String, Map<String, Run>> runs;

    /** @param measured hash of the measurements of the newest record */
    private record Run(LagStreak lag, long newest, int measured) {
        private boolean isFollowedBy(long time, long received, int nowMeasured) {
            return time > newest || time == newest && received > lag.reached() && nowMeasured != measured;
        }
    }

    ReportDelayedDevices(ReceiptTime receiptTime, Duration maxBehind) {
        this.receiptTime = receiptTime;
        this.maxBehindMillis = maxBehind.toMillis();
    }

    @Override
    public void open(OpenContext context) {
        runs = new LinkedHashMap<>() {
            @Override
            protected boolean removeEldestEntry(Map.Entry<String, Map<String, Run>> eldest) {
                return size() > MAX_DEVICES;
            }
        };
    }

    @Override
    public void processElement(TopicRecord record, Context context, Collector<ClockReport> out) {
        long received = receiptTime.of(record, record.timestamp(), System.currentTimeMillis());
        boolean isBehind = received - record.timestamp() > maxBehindMillis;
        if (!isBehind && runs.isEmpty() || !CorrectClocks.isOfDevice(record) || !isReported(record)) {
            return;
        }
        String device = CorrectClocks.deviceOf(record);
        Map<String, Run> byType = runs.remove(device);
        if (byType == null) {
            if (!isBehind) {
                return;
            }
            byType = new LinkedHashMap<>() {
                @Override
                protected boolean removeEldestEntry(Map.Entry<String, Run> eldest) {
                    return size() > MAX_TYPES;
                }
            };
        }
        Entity entity = entityOf(record);
        if (isBehind) {
            byType.put(entity.type(), after(byType.get(entity.type()), record, received, entity, out));
        } else {
            byType.remove(entity.type());
        }
        if (!byType.isEmpty()) {
            runs.put(device, byType);
        }
    }

    private static Run after(Run before, TopicRecord record, long received, Entity entity, Collector<ClockReport> out) {
        int measured = measured(entity);
        if (before != null && !before.isFollowedBy(record.timestamp(), received, measured)) {
            return before;
        }
        LaggingPosition position = new LaggingPosition(
                record.topic(),
                CorrectClocks.identity(record),
                CorrectClocks.id(record),
                "",
                record.timestamp(),
                received,
                Long.MIN_VALUE);
        LagStreak lag = LagStreak.after(before == null ? null : before.lag, position);
        boolean catchesUp = record.timestamp() - lag.first() > CATCHES_UP * (received - lag.since());
        if (!catchesUp && lag.isDue(MIN_RECORDS)) {
            String mission = entity.name("Mission").orElse("");
            out.collect(ClockReport.delayed(position, entity.type(), mission, lag));
            lag = lag.afterReport();
        }
        return new Run(lag, record.timestamp(), measured);
    }

    private static int measured(Entity entity) {
        Map<String, JsonNode> values = new HashMap<>();
        entity.attributes().forEach(each -> values.put(each.getKey(), each.getValue()));
        values.keySet().removeAll(Entity.BUILT_INS);
        values.keySet().removeIf(NOT_MEASURED.asMatchPredicate());
        values.entrySet().removeIf(each -> Entity.isOfCommand(each.getKey(), each.getValue()));
        values.replaceAll((name, each) -> each.path("value"));
        return values.hashCode();
    }

    private static boolean isReported(TopicRecord record) {
        return !Topics.isReplay(record.topic())
                && !Origin.REPAIR.code().equals(record.headers().get(HeaderNames.ORIGIN));
    }

    private static Entity entityOf(TopicRecord record) {
        try {
            return Entity.parse(record.value());
        } catch (UnreadableException e) { // another stage emits its dead letter
            return Entity.builder(CorrectClocks.id(record), "").build();
        }
    }
}
