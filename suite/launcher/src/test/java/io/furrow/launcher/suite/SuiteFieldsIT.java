package io.furrow.launcher.suite;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Properties;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.cli.option.CommandException;
import io.furrow.dashboard.page.PageSettings;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.http.AllowedNames;
import io.furrow.kafka.field.FieldChange;
import io.furrow.kafka.field.FieldsTopic;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

@Tag("full")
class SuiteFieldsIT {
    private static final String FEATURE =
            "{\"type\":\"Feature\",\"id\":\"%s\",\"properties\":{},\"geometry\":{\"type\":\"Polygon\","
                    + "\"coordinates\":[[[0,0],[%s,0],[0.01,0.01],[0,0.01],[0,0]]]}}";

    @TempDir
    Path folder;

    @Test
    void leavesToImportsWhatHasBeenImported() throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(folder.resolve("kafka"), 0);
                RunDirectory directory = RunDirectory.open(folder.resolve("data"))) {
            Properties client = kafka.client();
            FieldsTopic topic = new FieldsTopic(client);
            SuiteFields fields = new SuiteFields(topic);

            List<FieldVersion> demo = fields.write(ownBroker(null), directory);
            assertThat(demo).extracting(FieldVersion::validFrom).isNotEmpty().containsOnly(0L);
            assertThat(topic.read()).extracting(FieldVersion::id).contains("field-1");

            FieldVersion imported = demo.get(0);
            FieldVersion end = new FieldVersion(imported.id(), 1_000, null, imported.properties());
            topic.write(List.of(end));
            assertThat(fields.write(ownBroker(null), directory))
                    .as("there are fields")
                    .isEmpty();

            Path own = file(FEATURE.formatted("own", "0.01"));
            fields.write(ownBroker(own), directory);
            assertThat(FieldChange.asOf(System.currentTimeMillis(), topic.read()))
                    .as("the demonstration's are gone")
                    .containsOnlyKeys("own");
            assertThat(fields.write(ownBroker(own), directory))
                    .as("it is as it was")
                    .isEmpty();
            assertThat(topic.read()).extracting(FieldVersion::key).contains(end.key(), "own@1970-01-01T00:00:00.000Z");
        }
    }

    @Test
    void givesTheJobCollisionTheExclusionZonesThatHold() throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(folder.resolve("kafka"), 0);
                RunDirectory directory = RunDirectory.open(folder.resolve("data"))) {
            Properties client = kafka.client();
            FieldsTopic topic = new FieldsTopic(client);
            SuiteFields fields = new SuiteFields(topic);
            fields.write(ownBroker(null), directory);

            Path zones = fields.zones(directory).orElseThrow();
            FieldVersion yard = topic.read().stream()
                    .filter(FieldVersion::isExclusion)
                    .findFirst()
                    .orElseThrow();
            JsonNode features = NgsiJson.read(Files.readAllBytes(zones)).path("features");
            assertThat(features).hasSize(1);
            assertThat(features.at("/0/geometry")).isEqualTo(yard.geometry());

            topic.write(List.of(new FieldVersion(yard.id(), 1_000, null, yard.properties())));
            assertThat(fields.zones(directory)).isEmpty();
            assertThat(zones).as("it has ended").doesNotExist();
        }
    }

    @Test
    void givesABrokerThatRunsAlreadyOnlyTheFieldsOfAFile() throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(folder.resolve("kafka"), 0);
                RunDirectory directory = RunDirectory.open(folder.resolve("data"))) {
            String servers = kafka.bootstrapServers();
            Properties client = new Properties();
            client.setProperty("bootstrap.servers", servers);
            FieldsTopic topic = new FieldsTopic(client);
            SuiteFields fields = new SuiteFields(topic);

            assertThat(fields.write(settings(null, servers), directory)).isEmpty();
            assertThat(topic.read()).isEmpty();

            Path own = file(FEATURE.formatted("own", "0.01"));
            fields.write(settings(own, servers), directory);
            assertThat(topic.read()).extracting(FieldVersion::id).containsExactly("own");
        }
    }

    @Test
    void rejectsAFileThatCannotBeUsedWholly() throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(folder.resolve("kafka"), 0);
                RunDirectory directory = RunDirectory.open(folder.resolve("data"))) {
            Properties client = kafka.client();
            SuiteFields fields = new SuiteFields(new FieldsTopic(client));
            Path own = file(FEATURE.formatted("good", "0.01"), FEATURE.formatted("b d", "0.01"));

            assertThatThrownBy(() -> fields.write(ownBroker(own), directory))
                    .isInstanceOf(CommandException.class)
                    .hasMessageStartingWith("--fields " + own + ": feature 2 ");
            assertThat(new FieldsTopic(client).read()).isEmpty();
        }
    }

    @Test
    void reportsWhatItRepairsAndWhichCommandHasTheOption() throws Exception {
        Path crossing =
                file("{\"type\":\"Feature\",\"id\":\"bow\",\"properties\":{},\"geometry\":{\"type\":\"Polygon\","
                        + "\"coordinates\":[[[0,0],[0.02,0.02],[0.02,0],[0,0.02],[0,0]]]}}");
        assertThat(SuiteFields.requireUsable(ownBroker(crossing)))
                .singleElement()
                .asString()
                .startsWith("--fields: field bow: ")
                .contains("repaired: Self-intersection at longitude 0.01");

        Path unnamed = file(FEATURE.formatted("", "0.01"));
        assertThatThrownBy(() -> SuiteFields.requireUsable(ownBroker(unnamed)))
                .hasMessageContaining("with the option --id-property of ./furrow fields import");
    }

    private static SuiteSettings ownBroker(Path fields) {
        return settings(fields, null);
    }

    private static SuiteSettings settings(Path fields, String kafka) {
        return new SuiteSettings(
                null,
                SuiteSettings.Fiware.of("farm"),
                "10s",
                fields,
                SuiteSettings.Ports.free(),
                null,
                kafka,
                null,
                SuiteSettings.Farm.SIMULATED,
                SuiteSettings.Watch.DEFAULT,
                AllowedNames.NONE,
                PageSettings.DEFAULT,
                true);
    }

    private Path file(String... features) throws Exception {
        return Files.writeString(
                folder.resolve("own.geojson"),
                "{\"type\":\"FeatureCollection\",\"features\":[" + String.join(",", features) + "]}");
    }
}
