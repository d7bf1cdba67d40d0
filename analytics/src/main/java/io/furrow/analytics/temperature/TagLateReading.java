package io.furrow.analytics.temperature;

import java.time.Duration;
import java.time.Instant;
import java.util.Map;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.functions.RichMapFunction;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.windowing.windows.TimeWindow;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

/**
 * Turns a reading that arrived after its window was closed back into its record, with two additional headers:
 * {@value #FIELD} (id) and {@value #WINDOW} (its last window, {@code <start>/<end>} in ISO 8601). Counted as {@code late}.
 */
final class TagLateReading extends RichMapFunction<FieldReading, TopicRecord> {
    static final String FIELD = "late-field";
    static final String WINDOW = "late-window";
    private static final long serialVersionUID = 1L;

    private final String topic;
    private final long windowMillis;
    private final long slideMillis;
    private transient Counter late;

    TagLateReading(String topic, Duration window, Duration slide) {
        this.topic = topic;
        this.windowMillis = window.toMillis();
        this.slideMillis = slide.toMillis();
    }

    @Override
    public void open(OpenContext context) {
        late = getRuntimeContext().getMetricGroup().counter("late");
    }

    @Override
    public TopicRecord map(FieldReading reading) {
        late.inc();
        TopicRecord record = reading.reading().record();
        long time = reading.reading().time();
        long start = TimeWindow.getWindowStartWithOffset(time, 0, slideMillis);
        String window = Instant.ofEpochMilli(start) + "/" + Instant.ofEpochMilli(start + windowMillis);
        TopicRecord lateReading = record.to(Topics.resultOf(record.topic(), topic))
                .at(time)
                .with(Map.of(FIELD, reading.field(), WINDOW, window));
        return record.headers().containsKey(HeaderNames.REPLAY_OFFSET)
                ? lateReading.with(HeaderNames.REPLAY_OFFSET, "0")
                : lateReading;
    }
}
