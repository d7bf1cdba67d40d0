package io.furrow.analytics.clock;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.OptionalLong;
import java.util.Set;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.eventtime.SingleTimer;
import io.furrow.flink.record.ByType;
import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.result.ResultTypes;

/**
 * Corrects the event times of each device's records by the offset of its clock, before lateness is decided. Key: the device of a topic,
 * see {@link #deviceOf}. Entities that share an id have clocks of their own, by type. Watermarks still follow the times that the devices reported.
 *
 * <p><b>State</b>: the estimated offset of the device's clock by type, see {@link ClockOffset}. It depends only on the device's records in their
 * order, not on the wall clock, so that a restart and a second pass give the same.
 *
 * <p><b>Cleared</b>: a day of event time after the receipt that began the current span.
 *
 * <p><b>Late</b>: no record.
 *
 * <p><b>Emits</b>: every record once; a corrected one has the corrected timestamp, and the correction in the header {@value #HEADER}.
 * Records of replays, records with a missing or impossible receipt time, and results of Furrow stay unchanged. Each change of a device's
 * offset goes to {@link #REPORTS}. {@code corrected} counts records.
 */
public final class CorrectClocks extends KeyedProcessFunction<String, TopicRecord, TopicRecord> {
    static final OutputTag<ClockReport> REPORTS = new OutputTag<>("clock-reports") {
        private static final long serialVersionUID = 1L;
    };
    /** The milliseconds added to the device's time. */
    static final String HEADER = "clock-offset";

    private static final long serialVersionUID = 1L;
    private static final ByType.Descriptor<ClockOffset> OFFSET =
            new ByType.Descriptor<>("offset", ClockOffset.class, ClockOffset::type);
    private static final long KEPT = Duration.ofDays(1).toMillis();

    private final ReceiptTime receiptTime;
    private transient SingleTimer timer;
    private transient ByType<ClockOffset> offsets;
    private transient Counter corrected;

    CorrectClocks(ReceiptTime receiptTime) {
        this.receiptTime = receiptTime;
    }

    /** Topic, tenant, service path and key of the record, the key being the id of its entity. */
    static String deviceOf(TopicRecord record) {
        return record.topic() + '|' + identity(record);
    }

    @Override
    public void open(OpenContext context) {
        timer = new SingleTimer(getRuntimeContext());
        offsets = OFFSET.of(getRuntimeContext());
        corrected = getRuntimeContext().getMetricGroup().counter("corrected");
    }

    @Override
    public void processElement(TopicRecord record, Context context, Collector<TopicRecord> out) throws Exception {
        OptionalLong stamp = receiptTime.stamp(record, System.currentTimeMillis());
        if (stamp.isEmpty() || !isOfDevice(record)) {
            out.collect(record);
            return;
        }
        long received = stamp.getAsLong();
        String type = typeOf(record);
        ClockOffset before = offsets.get(type);
        ClockOffset now = before == null
                ? ClockOffset.first(record.timestamp(), received)
                : before.after(record.timestamp(), received);
        offsets.put(type, now.of(type));
        timer.ask(now.since() + KEPT, context.timerService());
        long time = now.corrected(record.timestamp(), received);
        if (before != null && before.millis() != now.millis()) {
            context.output(REPORTS, report(record, type, now.millis(), time));
        }
        if (now.millis() == 0) {
            out.collect(record);
        } else {
            corrected.inc();
            out.collect(record.at(time).with(HEADER, Long.toString(now.millis())));
        }
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<TopicRecord> out) throws Exception {
        timer.rang();
        for (ClockOffset each : offsets.allOf("")) {
            long end = each.since() + KEPT;
            if (end <= context.timerService().currentWatermark()) {
                offsets.remove(each);
            } else {
                timer.ask(end, context.timerService());
            }
        }
    }

    private static ClockReport report(TopicRecord record, String type, long millis, long time) {
        return new ClockReport(
                ClockReport.Kind.OFFSET, record.topic(), identity(record), id(record), type, "", millis, 0, 0, time);
    }

    private static String typeOf(TopicRecord record) {
        try {
            return Entity.parse(record.value(), Set.of()).type();
        } catch (UnreadableException e) { // another stage emits its dead letter
            return "";
        }
    }

    static String identity(TopicRecord record) {
        return FiwareScope.of(record.headers()).identity(id(record));
    }

    static boolean isOfDevice(TopicRecord record) {
        String id = id(record);
        return record.value() != null && !id.isEmpty() && !ResultTypes.isResult(id);
    }

    /** Empty if the record has no key. */
    static String id(TopicRecord record) {
        return record.key() == null ? "" : new String(record.key(), StandardCharsets.UTF_8);
    }
}
