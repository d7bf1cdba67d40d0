package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.functions.RichFlatMapFunction;
import org.apache.flink.metrics.Counter;
import org.apache.flink.util.Collector;

/** Gives a reading to every field that covers its position; readings outside of all fields are counted as {@code outside}. */
final class AssignFields extends RichFlatMapFunction<Reading, FieldReading> {
    private static final long serialVersionUID = 1L;

    private final ArrayList<Field> fields; // by its class, because it travels serialized
    private transient FieldIndex index;
    private transient Counter outside;

    AssignFields(List<Field> fields) {
        this.fields = new ArrayList<>(fields);
    }

    @Override
    public void open(OpenContext context) {
        index = new FieldIndex(fields);
        outside = getRuntimeContext().getMetricGroup().counter("outside");
    }

    @Override
    public void flatMap(Reading reading, Collector<FieldReading> out) {
        List<Field> covering = index.covering(reading.position());
        if (covering.isEmpty()) {
            outside.inc();
        }
        for (Field field : covering) {
            out.collect(new FieldReading(field.id(), field.domain(), reading));
        }
    }
}
