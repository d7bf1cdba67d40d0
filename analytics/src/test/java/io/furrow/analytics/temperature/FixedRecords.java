package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;

/** Records that are known at the start, in a form that travels with the job. */
final class FixedRecords implements TopicSnapshot {
    private static final long serialVersionUID = 1L;

    private final ArrayList<Object[]> records = new ArrayList<>();

    FixedRecords(List<TopicRecord> records) {
        for (TopicRecord record : records) {
            this.records.add(
                    new Object[] {record.topic(), record.partition(), record.offset(), record.key(), record.value()});
        }
    }

    @Override
    public List<TopicRecord> read() {
        return records.stream()
                .map(each -> new TopicRecord(
                        (String) each[0],
                        (int) each[1],
                        (long) each[2],
                        0,
                        (byte[]) each[3],
                        (byte[]) each[4],
                        Map.of()))
                .toList();
    }
}
