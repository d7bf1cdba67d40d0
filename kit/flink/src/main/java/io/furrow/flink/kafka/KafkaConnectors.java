package io.furrow.flink.kafka;

import java.time.Duration;
import java.util.Optional;
import java.util.Properties;
import java.util.regex.Pattern;

import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.connector.base.DeliveryGuarantee;
import org.apache.flink.connector.kafka.sink.KafkaSink;
import org.apache.flink.connector.kafka.sink.TransactionNamingStrategy;
import org.apache.flink.connector.kafka.source.KafkaSource;
import org.apache.flink.connector.kafka.source.KafkaSourceBuilder;
import org.apache.flink.connector.kafka.source.enumerator.initializer.OffsetsInitializer;
import org.apache.flink.connector.kafka.source.reader.deserializer.KafkaRecordDeserializationSchema;
import org.apache.kafka.clients.consumer.OffsetResetStrategy;

import io.furrow.flink.job.InputTopics;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.job.StartPosition;
import io.furrow.flink.job.TransactionTimeout;
import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.ClockBoundedWatermarks;
import io.furrow.flink.time.ReplayWatermarks;

/** Creates the Kafka sources and sinks of a job, with the common settings of all jobs of Furrow. */
public final class KafkaConnectors {
    static final int MAX_REQUEST_BYTES = 16 * 1024 * 1024;
    /** Short, because a backlog reaches the drift within as long, and then waits for the next alignment. */
    private static final Duration ALIGNMENT_INTERVAL = Duration.ofMillis(200);

    private KafkaConnectors() {}

    /** Reads the job's input from the configured position; only committed records. Record timestamps are the event times. */
    public static KafkaSource<TopicRecord> source(JobOptions options) {
        return source(options, new TopicRecordSchema());
    }

    /** The same for another record type. */
    public static <T> KafkaSource<T> source(JobOptions options, KafkaRecordDeserializationSchema<T> form) {
        InputTopics topics = options.inputTopics();
        KafkaSourceBuilder<T> source = source(options, form, options.groupId());
        topics.pattern().ifPresentOrElse(source::setTopicPattern, () -> source.setTopics(topics.names()));
        return source.setStartingOffsets(offsets(options.from())).build();
    }

    @SuppressWarnings("deprecation") // the connector's only form of "else from the beginning" takes Kafka's old enum
    private static OffsetsInitializer offsets(StartPosition from) {
        return switch (from.kind()) {
            case COMMITTED -> OffsetsInitializer.committedOffsets(OffsetResetStrategy.EARLIEST);
            case EARLIEST -> OffsetsInitializer.earliest();
            case LATEST -> OffsetsInitializer.latest();
            case TIME -> OffsetsInitializer.timestamp(from.time().orElseThrow().toEpochMilli());
        };
    }

    /** Reads a topic from its beginning, unbounded; waits for a topic that does not exist yet. */
    public static KafkaSource<TopicRecord> wholeTopic(JobOptions options, String topic) {
        return source(options, new TopicRecordSchema(), options.groupId() + "-" + topic)
                .setTopicPattern(Pattern.compile(Pattern.quote(topic)))
                .setStartingOffsets(OffsetsInitializer.earliest())
                .build();
    }

    private static <T> KafkaSourceBuilder<T> source(
            JobOptions options, KafkaRecordDeserializationSchema<T> form, String group) {
        return KafkaSource.<T>builder()
                .setBootstrapServers(options.bootstrapServers())
                .setGroupId(group)
                .setClientIdPrefix(group)
                .setProperties(consumerProperties(options))
                .setDeserializer(form);
    }

    static Properties consumerProperties(JobOptions options) {
        Properties properties = options.kafkaProperties();
        properties.setProperty("isolation.level", "read_committed"); // uncommitted records are skipped
        properties.putIfAbsent("partition.discovery.interval.ms", "10000");
        return properties;
    }

    /** Writes each record to the topic it names, under the job's delivery guarantee. */
    public static KafkaSink<TopicRecord> sink(JobOptions options) {
        return sink(options, "topics");
    }

    /** The same for one of several sinks of a job, whose transactions are separated by name. */
    static KafkaSink<TopicRecord> sink(JobOptions options, String name) {
        return sink(options, name, new TopicRecordSchema());
    }

    /** The same for another record type. */
    public static <T> KafkaSink<T> sink(JobOptions options, String name, AnyTopicSerializer<T> form) {
        return sinkOf(options, form, name, guarantee(options));
    }

    /** The same without transactions: records are visible immediately, whatever the job's delivery guarantee. */
    public static KafkaSink<TopicRecord> promptSink(JobOptions options, String name) {
        return sinkOf(options, new TopicRecordSchema(), name, DeliveryGuarantee.AT_LEAST_ONCE);
    }

    /** The same, for a writer inside another sink's. */
    static KafkaSink<TopicRecord> atLeastOnceSink(JobOptions options) {
        return sinkOf(options, new TopicRecordSchema(), "dead-letters", DeliveryGuarantee.AT_LEAST_ONCE);
    }

    private static DeliveryGuarantee guarantee(JobOptions options) {
        return switch (options.delivery()) {
            case AT_LEAST_ONCE -> DeliveryGuarantee.AT_LEAST_ONCE;
            case EXACTLY_ONCE -> DeliveryGuarantee.EXACTLY_ONCE;
        };
    }

    /**
     * Transactional ids are reused once their transactions have ended: a handful for each subtask. A sink aborts transactions with its
     * prefix, so no prefix may begin another: {@code furrow-<job>:<sink>:}.
     */
    private static <T> KafkaSink<T> sinkOf(
            JobOptions options, AnyTopicSerializer<T> form, String name, DeliveryGuarantee guarantee) {
        return KafkaSink.<T>builder()
                .setBootstrapServers(options.bootstrapServers())
                .setKafkaProducerConfig(producerProperties(options))
                .setDeliveryGuarantee(guarantee)
                .setTransactionalIdPrefix("furrow-" + options.jobName() + ":" + name + ":")
                .setTransactionNamingStrategy(TransactionNamingStrategy.POOLING)
                .setRecordSerializer(form)
                .build();
    }

    /** Settings of the producers of a job besides the bootstrap servers; {@code --kafka-properties} overrides them. */
    public static Properties producerProperties(JobOptions options) {
        Properties properties = options.kafkaProperties();
        options.producerDefaults().forEach(properties::putIfAbsent);
        properties.putIfAbsent("max.request.size", Integer.toString(MAX_REQUEST_BYTES));
        properties.putIfAbsent("batch.size", "262144");
        properties.putIfAbsent("compression.type", "lz4");
        properties.setProperty(
                "transaction.timeout.ms",
                Long.toString(TransactionTimeout.of(options).toMillis()));
        // A mission's topic may have just been created. With two requests in flight, the broker could refuse the first
        // (the partition does not exist yet), accept the second, and then refuse the first forever: two minutes without
        // any result until the producer gives up (KAFKA-15591).
        properties.putIfAbsent("max.in.flight.requests.per.connection", "1");
        return properties;
    }

    /**
     * Event time = record timestamp, less the job's out-of-orderness; see {@link ClockBoundedWatermarks}. For a replay, which one
     * subtask must read, it follows from its records alone; see {@link Epochs}.
     */
    public static WatermarkStrategy<TopicRecord> watermarks(JobOptions options) {
        ClockBoundedWatermarks.Hold hold = new ClockBoundedWatermarks.Hold(
                options.idleTimeout(), options.idleAdvance(), options.clocks().maxBehind());
        return options.inputTopics().replay().isPresent()
                ? ReplayWatermarks.strategy(options.outOfOrderness(), hold.idleTimeout())
                : WatermarkStrategy.forGenerator(
                        new ClockBoundedWatermarks.Supplier(ReceiptTime.of(options), options.outOfOrderness(), hold));
    }

    /**
     * The same for a job that buffers records ahead of event time: a partition that is ahead of the slowest by more than the drift
     * pauses until the slowest has come closer.
     */
    public static WatermarkStrategy<TopicRecord> watermarks(JobOptions options, Optional<Duration> maxDrift) {
        return maxDrift.map(drift -> watermarks(options).withWatermarkAlignment("input", drift, ALIGNMENT_INTERVAL))
                .orElseGet(() -> watermarks(options));
    }

    /** For a stream beside the events without event time: it is always idle, so that it neither holds back nor advances their watermark. */
    public static WatermarkStrategy<TopicRecord> alwaysIdle() {
        return WatermarkStrategy.forGenerator(context -> new AlwaysIdle());
    }

    private static final class AlwaysIdle implements WatermarkGenerator<TopicRecord> {
        @Override
        public void onEvent(TopicRecord event, long timestamp, WatermarkOutput output) {
            onPeriodicEmit(output);
        }

        @Override
        public void onPeriodicEmit(WatermarkOutput output) {
            output.markIdle();
        }
    }
}
