package io.furrow.control;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.kafka.CommittedReader;

/** What is committed on a topic at the moment. */
record TopicContent(Properties client, String topic) {
    List<ConsumerRecord<String, byte[]>> records() {
        List<ConsumerRecord<String, byte[]>> all = new ArrayList<>();
        try (CommittedReader<String> reader = CommittedReader.openExisting(client, topic)) {
            reader.readToEnd(all::add);
        }
        return all;
    }

    /** By key, as compaction would leave it. */
    Map<String, byte[]> newest() {
        Map<String, byte[]> newest = new LinkedHashMap<>();
        for (ConsumerRecord<String, byte[]> record : records()) {
            if (record.value() == null) {
                newest.remove(record.key());
            } else {
                newest.put(record.key(), record.value());
            }
        }
        return newest;
    }
}
