package io.furrow.launcher;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.FreePort;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

class CatalogIT {
    @TempDir
    static Path folder;

    private static EmbeddedKafka kafka;

    @BeforeAll
    static void start() throws Exception {
        kafka = EmbeddedKafka.start(folder, 0);
    }

    @AfterAll
    static void stop() throws Exception {
        kafka.close();
    }

    @Test
    void showsTheNewestOfEachEntryAndNothingWhereThereIsNothing() throws Exception {
        assertThat(said("catalog", "--kafka", kafka.bootstrapServers())).startsWith("Nothing is stored yet.");

        write("farm|north|weeding|Thermometer", "weeding", 1);
        write("farm|north|sowing|Camera", "sowing", 5);
        write("farm|north|weeding|Thermometer", "weeding", 2);
        write("farm|north|old|Camera", "old", 9);
        write("farm|north|old|Camera", null, 0);

        List<JsonNode> all = json("catalog", "--kafka", kafka.bootstrapServers(), "--output", "json");
        assertThat(all)
                .extracting(entry -> entry.path("mission").asText() + " "
                        + entry.path("events").asInt())
                .containsExactly("sowing 5", "weeding 2");
        assertThat(json("catalog", "--kafka", kafka.bootstrapServers(), "--output", "json", "--mission", "weeding"))
                .hasSize(1);
        assertThat(said("catalog", "--kafka", kafka.bootstrapServers()).lines())
                .anyMatch(line -> line.startsWith("north / weeding"));
    }

    @Test
    void saysThatKafkaDoesNotAnswer() {
        assertThat(said("catalog", "--kafka", "127.0.0.1:" + FreePort.orFree(0)))
                .contains("cannot be read")
                .contains("Check the address given with --kafka");
    }

    private static void write(String key, String mission, int events) throws Exception {
        byte[] value = mission == null
                ? null
                : "{\"service\":\"farm\",\"domain\":\"north\",\"mission\":\"%s\",\"type\":\"T\",\"events\":%d}"
                        .formatted(mission, events)
                        .getBytes(StandardCharsets.UTF_8);
        try (KafkaProducer<String, byte[]> producer = new KafkaProducer<>(
                Map.of("bootstrap.servers", kafka.bootstrapServers()),
                new StringSerializer(),
                new ByteArraySerializer())) {
            producer.send(new ProducerRecord<>("data.catalog", key, value)).get();
        }
    }

    private static List<JsonNode> json(String... args) throws Exception {
        List<JsonNode> entries = new ArrayList<>();
        NgsiJson.read(said(args).getBytes(StandardCharsets.UTF_8)).forEach(entries::add);
        return entries;
    }

    private static String said(String... args) {
        StringWriter said = new StringWriter();
        CommandLine line = Furrow.commandLine();
        line.setOut(new PrintWriter(said)).setErr(new PrintWriter(said));
        line.execute(args);
        return said.toString();
    }
}
