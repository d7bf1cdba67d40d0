package io.furrow.analytics.clock;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.OptionalLong;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.eventtime.SingleTimer;
import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.result.ResultTypes;

/**
 * Corrects the event times of each device's records by the offset of its clock, before lateness is decided. Key: the device of a topic,
 * see {@link #deviceOf}. Watermarks still follow the times that the devices reported.
 *
 * <p><b>State</b>: the estimated offset of the device's clock, see {@link ClockOffset}. It depends only on the device's records in their
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
    private static final long KEPT = Duration.ofDays(1).toMillis();

    private final ReceiptTime receiptTime;
    private transient SingleTimer timer;
    private transient ValueState<ClockOffset> offset;
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
        offset = getRuntimeContext().getState(new ValueStateDescriptor<>("offset", ClockOffset.class));
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
        ClockOffset before = offset.value();
        ClockOffset now = before == null
                ? ClockOffset.first(record.timestamp(), received)
                : before.after(record.timestamp(), received);
        offset.update(now);
        timer.ask(now.since() + KEPT, context.timerService());
        long time = now.corrected(record.timestamp(), received);
        if (before != null && before.millis() != now.millis()) {
            context.output(REPORTS, report(record, now.millis(), time));
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
        long end = offset.value().since() + KEPT;
        if (end <= context.timerService().currentWatermark()) {
            offset.clear();
        } else {
            timer.ask(end, context.timerService());
        }
    }

    private static ClockReport report(TopicRecord record, long millis, long time) {
        return new ClockReport(
                ClockReport.Kind.OFFSET, record.topic(), identity(record), id(record), "", "", millis, 0, 0, time);
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
