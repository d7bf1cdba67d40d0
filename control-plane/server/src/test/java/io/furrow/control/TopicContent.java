package io.furrow.control;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.kafka.CommittedReader;

/** Reads the committed records of a topic. */
record TopicContent(Properties client, String topic) {
    List<ConsumerRecord<String, byte[]>> records() {
        List<ConsumerRecord<String, byte[]>> all = new ArrayList<>();
        try (CommittedReader<String> reader = CommittedReader.openExisting(client, topic)) {
            reader.readToEnd(all::add);
        }
        return all;
    }

    /** Returns the newest values by key, as compaction would leave them. */
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
