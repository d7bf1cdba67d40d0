package io.furrow.analytics.coverage;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.topic.Topics;

/** Records of fields that travel with a job. */
final class StoredFields implements TopicSnapshot {
    private static final long serialVersionUID = 1L;

    private final ArrayList<byte[]> keys = new ArrayList<>();
    private final ArrayList<byte[]> values = new ArrayList<>();

    StoredFields(List<TopicRecord> fields) {
        for (TopicRecord field : fields) {
            keys.add(field.key());
            values.add(field.value());
        }
    }

    @Override
    public List<TopicRecord> read() {
        List<TopicRecord> records = new ArrayList<>();
        for (int i = 0; i < keys.size(); i++) {
            records.add(new TopicRecord(Topics.FIELDS, 0, i, 0, keys.get(i), values.get(i), Map.of()));
        }
        return records;
    }
}
