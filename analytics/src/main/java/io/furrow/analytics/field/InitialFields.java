package io.furrow.analytics.field;

import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.topic.Topics;

/** Fields that are part of the job, instead of those on {@code service.fields}. */
final class InitialFields implements TopicSnapshot {
    private static final long serialVersionUID = 1L;

    private final ArrayList<String> keys = new ArrayList<>(); // by its class, because it is serialized
    private final ArrayList<byte[]> values = new ArrayList<>();

    InitialFields(List<FieldVersion> fields) {
        for (FieldVersion field : fields) {
            keys.add(field.key());
            values.add(field.toBytes());
        }
    }

    @Override
    public List<TopicRecord> read() {
        List<TopicRecord> records = new ArrayList<>();
        for (int i = 0; i < keys.size(); i++) {
            byte[] key = keys.get(i).getBytes(StandardCharsets.UTF_8);
            records.add(new TopicRecord(Topics.FIELDS, 0, i, 0, key, values.get(i), Map.of()));
        }
        return records;
    }
}
