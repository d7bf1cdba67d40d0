package io.furrow.control.manager;

import java.util.List;
import java.util.Properties;

import org.apache.kafka.common.errors.TimeoutException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.StreamsConfig;
import org.apache.kafka.streams.TopologyTestDriver;
import org.apache.kafka.streams.kstream.Consumed;
import org.apache.kafka.streams.kstream.KStream;
import org.apache.kafka.streams.kstream.Produced;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.Record;
import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.CommandResult;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** A processor that throws an unexpected exception. */
class FailureHandlerTest {
    @AutoClose
    private TopologyTestDriver driver;

    private static final class Failing extends ContextualProcessor<String, byte[], String, byte[]> {
        @Override
        public void process(Record<String, byte[]> record) {
            String text = new String(record.value(), UTF_8);
            if (text.contains("fault")) {
                throw new IllegalStateException("nobody expected this");
            } else if (text.contains("away")) {
                throw new TimeoutException("Kafka does not answer");
            }
            context().forward(record);
        }
    }

    @Test
    void writesADeadLetterForAFailingRecordAndContinues() {
        start(Topics.RAW, false);
        pipe(Topics.RAW, "{'fault':1}");
        pipe(Topics.RAW, "{'fine':1}");

        TestRecord<String, byte[]> deadLetter = read(Topics.dead(Topics.RAW)).get(0);
        assertThat(text(deadLetter)).isEqualTo("{'fault':1}");
        assertThat(header(deadLetter, DeadLetter.REASON)).isEqualTo("failed");
        assertThat(header(deadLetter, DeadLetter.MESSAGE)).contains("nobody expected this");
        assertThat(header(deadLetter, DeadLetter.SOURCE)).isEqualTo("data.raw-0@0");
        assertThat(read("out")).hasSize(1);
    }

    @Test
    void answersARequestThatFails() throws Exception {
        start(Topics.MISSION_MANAGER, true);
        pipe(Topics.MISSION_MANAGER, "{\"type\":\"request\",\"requestId\":\"r-1\",\"mission\":\"m\",\"fault\":1}");

        assertThat(read(Topics.dead(Topics.MISSION_MANAGER))).hasSize(1);
        List<TestRecord<String, byte[]>> answers = read(Topics.MISSION_MANAGER);
        CommandResult answer = CommandResult.read(answers.get(0).value());
        assertThat(answer.error()).contains("internal-error");
        assertThat(answer.requestId()).contains("r-1");
        assertThat(answer.json().path("mission").asText()).isEqualTo("m");
    }

    /** Then the record is read again. */
    @Test
    void writesNoDeadLetterIfKafkaFailed() {
        start(Topics.RAW, false);
        assertThatThrownBy(() -> pipe(Topics.RAW, "{'away':1}")).hasRootCauseInstanceOf(TimeoutException.class);
        assertThat(read(Topics.dead(Topics.RAW))).isEmpty();
    }

    private void start(String topic, boolean repartitions) {
        StreamsBuilder builder = new StreamsBuilder();
        KStream<String, byte[]> stream = builder.stream(topic, Consumed.with(Serdes.String(), Serdes.ByteArray()));
        if (repartitions) {
            stream = ManagerTopology.toSinglePartition(stream.process(SourcePositionProcessor::new), "in-line");
        }
        stream.process(Failing::new).to("out", Produced.with(Serdes.String(), Serdes.ByteArray()));
        Properties settings = new Properties();
        settings.put(StreamsConfig.APPLICATION_ID_CONFIG, "failing");
        settings.put(StreamsConfig.BOOTSTRAP_SERVERS_CONFIG, "unused:0");
        settings.put(StreamsConfig.PROCESSING_EXCEPTION_HANDLER_CLASS_CONFIG, FailureHandler.class);
        driver = new TopologyTestDriver(builder.build(), settings);
    }

    private void pipe(String topic, String value) {
        driver.createInputTopic(topic, new StringSerializer(), new ByteArraySerializer())
                .pipeInput("key", value.getBytes(UTF_8));
    }

    private List<TestRecord<String, byte[]>> read(String topic) {
        return driver.createOutputTopic(topic, new StringDeserializer(), new ByteArrayDeserializer())
                .readRecordsToList();
    }

    private static String text(TestRecord<String, byte[]> record) {
        return new String(record.value(), UTF_8);
    }

    private static String header(TestRecord<String, byte[]> record, String name) {
        return new String(record.headers().lastHeader(name).value(), UTF_8);
    }
}
