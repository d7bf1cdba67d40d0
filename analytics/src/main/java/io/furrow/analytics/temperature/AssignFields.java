package io.furrow.analytics.temperature;

import java.io.IOException;
import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.streaming.api.functions.co.BroadcastProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.field.Field;
import io.furrow.analytics.field.FieldVersions;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;

/**
 * Emits a reading once for each field that covers its position at its time.
 *
 * <p>State: none in Flink, see {@link FieldVersions}. Late: a version that arrives after a reading of its time does not change
 * that reading's fields. Emits: a reading once per field; counts readings {@code inside} and {@code outside} of all fields,
 * and {@code fieldChanges}.
 */
public final class AssignFields extends BroadcastProcessFunction<Reading, TopicRecord, FieldReading> {
    private static final long serialVersionUID = 1L;

    private final TopicSnapshot atStart;
    private transient FieldVersions fields;
    private transient Counter inside;
    private transient Counter outside;
    private transient Counter changes;

    public AssignFields(TopicSnapshot atStart) {
        this.atStart = atStart;
    }

    @Override
    public void open(OpenContext context) throws IOException {
        fields = FieldVersions.read(atStart);
        MetricGroup metrics = getRuntimeContext().getMetricGroup();
        inside = metrics.counter("inside");
        outside = metrics.counter("outside");
        changes = metrics.counter("fieldChanges");
    }

    @Override
    public void processElement(Reading reading, ReadOnlyContext context, Collector<FieldReading> out) {
        List<Field> covering = fields.covering(reading.position(), reading.time());
        (covering.isEmpty() ? outside : inside).inc();
        for (Field field : covering) {
            out.collect(new FieldReading(field.id(), field.domain(), field.validFrom(), reading));
        }
    }

    @Override
    public void processBroadcastElement(TopicRecord record, Context context, Collector<FieldReading> out) {
        if (fields.take(record)) {
            changes.inc();
        }
    }
}
