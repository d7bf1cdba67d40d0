package io.furrow.bench.ingest;

import java.util.List;

import org.apache.flink.api.common.functions.FlatMapFunction;
import org.apache.flink.api.common.typeinfo.TypeHint;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.connector.kafka.source.reader.deserializer.KafkaRecordDeserializationSchema;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.util.Collector;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.kafka.AnyTopicSerializer;
import io.furrow.flink.kafka.KafkaConnectors;

import static org.apache.flink.api.common.eventtime.WatermarkStrategy.noWatermarks;

/**
 * A minimal Flink job between the same topics: forwards key, value, headers and timestamp of each record as bytes, with the
 * environment and the Kafka clients of the job {@code ingest}. It has no decoding, no shuffle and no state.
 */
final class CopyJob {
    private CopyJob() {}

    /** @param missionTopics used in turn; empty if each record goes to the topic of the domain only */
    static StreamExecutionEnvironment assemble(JobOptions options, String domainTopic, List<String> missionTopics) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);
        Configuration anyType = new Configuration();
        anyType.set(PipelineOptions.GENERIC_TYPES, true); // never serialized: source to sink is one task
        env.configure(anyType);

        env.fromSource(KafkaConnectors.source(options, new AsReceived()), noWatermarks(), "Read records")
                .uid("read-records")
                .flatMap(new NameTopics(domainTopic, missionTopics))
                .uid("name-topics")
                .name("Name topics")
                .sinkTo(KafkaConnectors.sink(options, "copies", new AsWasReceived()))
                .uid("write-copies")
                .name("Write copies");

        return env;
    }

    /** A record on its way to a topic. */
    record Copy(String topic, ConsumerRecord<byte[], byte[]> record) {}

    private static final class NameTopics implements FlatMapFunction<ConsumerRecord<byte[], byte[]>, Copy> {
        private static final long serialVersionUID = 1L;

        private final String domainTopic;
        private final String[] missionTopics;

        NameTopics(String domainTopic, List<String> missionTopics) {
            this.domainTopic = domainTopic;
            this.missionTopics = missionTopics.toArray(String[]::new);
        }

        @Override
        public void flatMap(ConsumerRecord<byte[], byte[]> record, Collector<Copy> out) {
            out.collect(new Copy(domainTopic, record));
            if (missionTopics.length > 0) {
                out.collect(new Copy(missionTopics[(int) (record.offset() % missionTopics.length)], record));
            }
        }
    }

    private static final class AsReceived implements KafkaRecordDeserializationSchema<ConsumerRecord<byte[], byte[]>> {
        private static final long serialVersionUID = 1L;

        @Override
        public void deserialize(ConsumerRecord<byte[], byte[]> record, Collector<ConsumerRecord<byte[], byte[]>> out) {
            out.collect(record);
        }

        @Override
        public TypeInformation<ConsumerRecord<byte[], byte[]>> getProducedType() {
            return TypeInformation.of(new TypeHint<>() {});
        }
    }

    private static final class AsWasReceived implements AnyTopicSerializer<Copy> {
        private static final long serialVersionUID = 1L;

        @Override
        public ProducerRecord<byte[], byte[]> serialize(Copy copy, KafkaSinkContext context, Long timestamp) {
            ConsumerRecord<byte[], byte[]> record = copy.record();
            return new ProducerRecord<>(
                    copy.topic(), null, record.timestamp(), record.key(), record.value(), record.headers());
        }
    }
}
