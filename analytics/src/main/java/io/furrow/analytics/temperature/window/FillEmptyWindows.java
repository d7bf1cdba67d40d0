package io.furrow.analytics.temperature.window;

import java.io.IOException;
import java.util.List;
import java.util.Optional;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.functions.co.KeyedBroadcastProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.field.Field;
import io.furrow.analytics.field.KnownFields;
import io.furrow.analytics.temperature.TemperatureOptions;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.EndOfEventTime;
import io.furrow.flink.time.Epochs;

/**
 * Adds a result of no devices for each window of a field without a reading: from the field's first reading on, as event time
 * passes the ends of the windows, for as long as a field of this id is there and for a limited time after its last reading. At
 * the end of a bounded input, and of an epoch of a replay, nothing follows the field's last reading, since no event time is known
 * beyond.
 *
 * <p>State: of each field that has reported, the window that comes next. Cleared: when the field has ended, has been silent
 * for the limit, or the input ends. Late: a corrected result is passed on, also after an empty one. Emits: results as they
 * come, and empty ones in the order of their windows.
 */
public final class FillEmptyWindows
        extends KeyedBroadcastProcessFunction<String, FieldAverage, TopicRecord, FieldAverage> {
    private static final long serialVersionUID = 1L;

    private final TopicSnapshot atStart;
    private final long window;
    private final long slide;
    private final long limit;
    private transient KnownFields fields;
    private transient ValueState<SilentField> silent;

    public FillEmptyWindows(TopicSnapshot atStart, TemperatureOptions options) {
        this.atStart = atStart;
        this.window = options.window().toMillis();
        this.slide = options.slide().toMillis();
        this.limit = options.emptyWindows().toMillis();
    }

    @Override
    public void open(OpenContext context) throws IOException {
        fields = KnownFields.read(atStart);
        silent = getRuntimeContext()
                .getState(new ValueStateDescriptor<>("silent", TypeInformation.of(SilentField.class)));
    }

    @Override
    public void processBroadcastElement(TopicRecord record, Context context, Collector<FieldAverage> out) {
        fields.take(record);
    }

    /** The windows of a field come in order: what is left out before a result had no reading. */
    @Override
    public void processElement(FieldAverage result, ReadOnlyContext context, Collector<FieldAverage> out)
            throws Exception {
        long start = result.windowStart();
        SilentField known = silent.value();
        if (known != null && Epochs.isOver(known.heard(), start)) {
            known = null;
        }
        while (known != null && known.next() < start) {
            known = isWithinLimit(known) && empty(known, out) ? known.after(slide) : null;
        }
        out.collect(result);
        long awaited = silent.value() == null ? Long.MIN_VALUE : silent.value().next();
        SilentField heard = known == null
                ? new SilentField(result.field(), result.scope(), start, start + slide)
                : known.heard(start, slide);
        silent.update(heard);
        if (heard.next() != awaited) {
            context.timerService().registerEventTimeTimer(lastInstant(heard));
        }
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<FieldAverage> out) throws Exception {
        SilentField known = silent.value();
        if (known == null || time != lastInstant(known)) {
            return; // of a window whose result has come
        }
        long watermark = context.timerService().currentWatermark();
        boolean isEnd = EndOfEventTime.isAt(watermark) || Epochs.isOver(known.heard(), watermark);
        if (isEnd || !isWithinLimit(known) || !empty(known, out)) {
            silent.clear();
            return;
        }
        SilentField next = known.after(slide);
        silent.update(next);
        context.timerService().registerEventTimeTimer(lastInstant(next));
    }

    private long lastInstant(SilentField known) {
        return known.next() + window - 1;
    }

    private boolean isWithinLimit(SilentField known) {
        return known.next() - known.heard() <= limit;
    }

    /** Whether the field is there at an end of the window. */
    private boolean empty(SilentField known, Collector<FieldAverage> out) {
        Optional<Field> field =
                fields.at(known.field(), lastInstant(known)).or(() -> fields.at(known.field(), known.next()));
        field.ifPresent(there -> out.collect(new FieldAverage(
                known.field(),
                there.domain(),
                known.scope(),
                known.next(),
                known.next() + window,
                RobustMean.OF_NONE,
                List.of())));
        return field.isPresent();
    }
}
