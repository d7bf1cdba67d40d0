package io.furrow.launcher.status;

import java.util.HashMap;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.ExecutionException;
import java.util.regex.Pattern;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.ListOffsetsResult.ListOffsetsResultInfo;
import org.apache.kafka.clients.admin.OffsetSpec;
import org.apache.kafka.clients.admin.TopicDescription;
import org.apache.kafka.common.TopicPartition;

/** Counts all records ever written to each {@code data.*} topic, from end offsets. */
final class TopicTotals {
    private static final Pattern OURS = Pattern.compile("data\\..+");

    private final Admin admin;

    TopicTotals(Admin admin) {
        this.admin = admin;
    }

    /** Records by topic, sorted by name. */
    TreeMap<String, Long> read() throws InterruptedException, ExecutionException {
        var names = admin.listTopics().names().get().stream()
                .filter(OURS.asMatchPredicate())
                .toList();
        Map<TopicPartition, OffsetSpec> ends = new HashMap<>();
        for (TopicDescription topic :
                admin.describeTopics(names).allTopicNames().get().values()) {
            topic.partitions()
                    .forEach(partition ->
                            ends.put(new TopicPartition(topic.name(), partition.partition()), OffsetSpec.latest()));
        }
        TreeMap<String, Long> totals = new TreeMap<>();
        for (Map.Entry<TopicPartition, ListOffsetsResultInfo> end :
                admin.listOffsets(ends).all().get().entrySet()) {
            totals.merge(end.getKey().topic(), end.getValue().offset(), Long::sum);
        }
        return totals;
    }
}
