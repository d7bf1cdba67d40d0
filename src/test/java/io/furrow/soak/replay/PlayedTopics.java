package io.furrow.soak.replay;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.soak.CommittedState;
import io.furrow.soak.replay.PlayedEpochs.Entry;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Reads the topics of all steered replays and prints their faults. */
public final class PlayedTopics {
    private static final int MAX_SHOWN = 20;

    private final String bootstrapServers;
    private final String fault;
    private final Random random;

    private PlayedTopics(String bootstrapServers, String fault, long seed) {
        this.bootstrapServers = bootstrapServers;
        this.fault = fault;
        this.random = new Random(seed);
    }

    /**
     * Arguments: bootstrap servers, at-least-once or exactly-once, number of replays, fault to insert (none, lost,
     * doubled), seed. The exit code is 0 if there are no faults.
     */
    public static void main(String... args) throws UnreadableException {
        PlayedTopics topics = new PlayedTopics(args[0], args[3], Long.parseLong(args[4]));
        boolean exactlyOnce = args[1].equals("exactly-once");
        int faults = 0;
        for (int i = 0; i < Integer.parseInt(args[2]); i++) {
            faults += topics.check(SteeredReplay.topic(i), exactlyOnce);
        }
        System.exit(faults == 0 ? 0 : 1);
    }

    private int check(String topic, boolean exactlyOnce) throws UnreadableException {
        List<ConsumerRecord<String, byte[]>> records = new ArrayList<>();
        CommittedState.read(bootstrapServers, List.of(topic), records::add);
        insertFault(records);
        PlayedEpochs epochs = new PlayedEpochs();
        int partitions = 0;
        for (ConsumerRecord<String, byte[]> record : records) {
            partitions = Math.max(partitions, record.partition() + 1);
            epochs.add(
                    number(record, HeaderNames.REPLAY_EPOCH),
                    number(record, HeaderNames.REPLAY_SEQUENCE),
                    entry(record));
        }
        List<String> faults = new ArrayList<>(epochs.gaps());
        faults.addAll(epochs.changed());
        if (exactlyOnce) {
            faults.addAll(epochs.faultsOfExactlyOnce(partitions));
        }
        System.out.printf(
                "%s: %d epochs, %d records, %d sequences more than once, %d faults%n",
                topic, epochs.count(), epochs.records(), epochs.repeated(), faults.size());
        faults.stream().limit(MAX_SHOWN).forEach(each -> System.out.println("    " + each));
        return faults.size() + (records.isEmpty() ? 1 : 0);
    }

    /** Removes or repeats a record. */
    private void insertFault(List<ConsumerRecord<String, byte[]>> records) {
        if (fault.equals("none")) {
            return;
        }
        int index = random.nextInt(records.size());
        while (!header(records.get(index), HeaderNames.REPLAY_KIND).equals("event")) {
            index = random.nextInt(records.size());
        }
        if (fault.equals("lost")) {
            records.remove(index);
        } else {
            records.add(records.get(index));
        }
    }

    private static Entry entry(ConsumerRecord<String, byte[]> record) throws UnreadableException {
        String kind = header(record, HeaderNames.REPLAY_KIND);
        long number = kind.equals("event")
                ? NgsiJson.read(record.value())
                        .path(SteeredReplay.NUMBER)
                        .path("value")
                        .asLong()
                : -1;
        return new Entry(kind, record.partition(), number);
    }

    private static long number(ConsumerRecord<String, byte[]> record, String name) {
        return Long.parseLong(header(record, name));
    }

    private static String header(ConsumerRecord<String, byte[]> record, String name) {
        return new String(record.headers().lastHeader(name).value(), UTF_8);
    }
}
