package io.furrow.ingest;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Devices as they stand on {@code service.devices}, in the order of the topic. */
record FixedDevices(ArrayList<byte[]> values) implements TopicSnapshot {
    static FixedDevices of(DeviceVersion... versions) {
        ArrayList<byte[]> values = new ArrayList<>();
        for (DeviceVersion version : versions) {
            values.add(version.toBytes());
        }
        return new FixedDevices(values);
    }

    @Override
    public List<TopicRecord> read() {
        List<TopicRecord> records = new ArrayList<>();
        for (byte[] value : values) {
            byte[] key = "ignored".getBytes(UTF_8);
            records.add(new TopicRecord(Topics.DEVICES, 0, records.size(), 0, key, value, Map.of()));
        }
        return records;
    }
}
