package io.furrow.kafka;

import java.util.Collection;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ExecutionException;
import java.util.stream.Collectors;

import org.apache.kafka.clients.admin.AbortTransactionSpec;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.DescribeTransactionsResult;
import org.apache.kafka.clients.admin.ListTopicsOptions;
import org.apache.kafka.clients.admin.ListTransactionsOptions;
import org.apache.kafka.clients.admin.TopicDescription;
import org.apache.kafka.clients.admin.TransactionListing;
import org.apache.kafka.clients.admin.TransactionState;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.TransactionalIdNotFoundException;
import org.apache.kafka.common.utils.Utils;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.text.FailureText;

/**
 * Aborts the transactions that are open in a partition although no coordinator knows them. A power cut leaves them on a single broker,
 * where the partition and the coordinator's log are as they were at different moments. Whoever reads committed records would wait for
 * their end forever, and Kafka Streams would never restore its state.
 */
public final class HangingTransactions {
    private static final Logger LOG = LoggerFactory.getLogger(HangingTransactions.class);
    private static final Set<TransactionState> UNFINISHED = Set.of(
            TransactionState.ONGOING,
            TransactionState.PREPARE_COMMIT,
            TransactionState.PREPARE_ABORT,
            TransactionState.PREPARE_EPOCH_FENCE);
    private static final String COORDINATOR_LOG = "__transaction_state";

    private HangingTransactions() {}

    private record Open(TopicPartition partition, long producer, int epoch, int coordinatorEpoch, long start) {}

    /**
     * Aborts them. Requires a single broker and the right to describe all transactions.
     *
     * @return their number
     */
    public static int abort(Admin admin) throws InterruptedException, ExecutionException {
        Set<Open> hanging = open(admin, partitions(admin));
        if (hanging.isEmpty()) {
            return 0;
        }
        // Twice, because a single broker loses and regains its leadership at its start, and lists nothing in between.
        for (int round = 0; round < 2; round++) {
            awaitCoordinators(admin);
            Set<Long> known = unfinished(admin);
            hanging.removeIf(each -> known.contains(each.producer()));
            // What is still open was open while no coordinator knew it: no ongoing transaction is, since its
            // coordinator learns of it first.
            hanging.retainAll(open(admin, hanging.stream().map(Open::partition).collect(Collectors.toSet())));
        }
        int aborted = 0;
        for (Open each : hanging) {
            try {
                admin.abortTransaction(new AbortTransactionSpec(
                                each.partition(), each.producer(), (short) each.epoch(), each.coordinatorEpoch()))
                        .all()
                        .get();
                aborted++;
                LOG.warn(
                        "aborted a transaction of producer {} in {} from offset {}, which no coordinator knows, as after a power cut",
                        each.producer(),
                        each.partition(),
                        each.start());
            } catch (ExecutionException e) {
                LOG.warn(
                        "the transaction of producer {} in {} from offset {}, which no coordinator knows, cannot be aborted ({}); if it stays, use kafka-transactions.sh abort",
                        each.producer(),
                        each.partition(),
                        each.start(),
                        FailureText.of(e));
            }
        }
        return aborted;
    }

    /** A coordinator that loads its log would list too little. Each describes a transaction, which does not exist, once it has loaded. */
    private static void awaitCoordinators(Admin admin) throws InterruptedException, ExecutionException {
        int coordinators = admin.describeTopics(List.of(COORDINATOR_LOG))
                .allTopicNames()
                .get()
                .get(COORDINATOR_LOG)
                .partitions()
                .size();
        Map<Integer, String> ids = new HashMap<>();
        for (int number = 0; ids.size() < coordinators; number++) {
            String id = "furrow-none-" + number;
            ids.putIfAbsent(Utils.abs(id.hashCode()) % coordinators, id);
        }
        DescribeTransactionsResult described = admin.describeTransactions(ids.values());
        for (String id : ids.values()) {
            try {
                described.description(id).get();
            } catch (ExecutionException e) {
                if (!(e.getCause() instanceof TransactionalIdNotFoundException)) {
                    throw e;
                }
            }
        }
    }

    private static Set<Long> unfinished(Admin admin) throws InterruptedException, ExecutionException {
        return admin.listTransactions(new ListTransactionsOptions().filterStates(UNFINISHED)).all().get().stream()
                .map(TransactionListing::producerId)
                .collect(Collectors.toSet());
    }

    private static List<TopicPartition> partitions(Admin admin) throws InterruptedException, ExecutionException {
        Collection<String> names = admin.listTopics(new ListTopicsOptions().listInternal(true))
                .names()
                .get();
        Collection<TopicDescription> topics =
                admin.describeTopics(names).allTopicNames().get().values();
        return topics.stream()
                .flatMap(topic -> topic.partitions().stream()
                        .map(partition -> new TopicPartition(topic.name(), partition.partition())))
                .toList();
    }

    private static Set<Open> open(Admin admin, Collection<TopicPartition> partitions)
            throws InterruptedException, ExecutionException {
        Set<Open> open = new HashSet<>();
        admin.describeProducers(partitions)
                .all()
                .get()
                .forEach((partition, state) -> state.activeProducers()
                        .forEach(producer -> producer.currentTransactionStartOffset()
                                .ifPresent(start -> open.add(new Open(
                                        partition,
                                        producer.producerId(),
                                        producer.producerEpoch(),
                                        producer.coordinatorEpoch().orElse(0),
                                        start)))));
        return open;
    }
}
