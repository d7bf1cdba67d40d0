package io.furrow.deployment;

import java.io.IOException;
import java.io.InputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.ObjectMapper;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.mongodb.ConnectionString;
import com.mongodb.MongoCredential;
import com.networknt.schema.JsonSchemaFactory;
import com.networknt.schema.SpecVersion.VersionFlag;
import org.apache.kafka.connect.runtime.distributed.DistributedConfig;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import picocli.CommandLine;

import io.furrow.analytics.AnalyticsJobs;
import io.furrow.containers.PinnedService;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;
import io.furrow.ingest.IngestJobs;
import io.furrow.launcher.Furrow;
import io.furrow.model.result.AnalyticsKind;
import io.furrow.replay.ReplayJobs;

import static org.assertj.core.api.Assertions.assertThat;

/** Checks the files of the deployment against the specification of Compose and the programs that they start, without a container engine. */
class ComposeFileTest {
    private static final Map<String, Class<?>> JOBS = Map.of(
            "ingest.jar", IngestJobs.class, "analytics.jar", AnalyticsJobs.class, "replay.jar", ReplayJobs.class);
    /** Services that end after their work. */
    private static final String ONE_SHOT = "topics|connectors";
    /** Services without a port to probe. */
    private static final String UNPROBED = "datanode|replay-analytics|simulators|taskmanager|job-.*";

    private final ComposeFile compose = ComposeFile.read();

    ComposeFileTest() throws IOException {}

    @Test
    void conformsToTheSpecification() throws IOException {
        try (InputStream schema = getClass().getResourceAsStream("/compose-spec/compose-spec.json")) {
            ObjectNode specification = new ObjectMapper().readValue(schema, ObjectNode.class);
            specification.remove("$id"); // it is not a URL
            assertThat(JsonSchemaFactory.getInstance(VersionFlag.V202012)
                            .getSchema(specification)
                            .validate(compose.root()))
                    .isEmpty();
        }
    }

    @Test
    void runsExistingCommandsWithExistingOptions() {
        Map<String, List<String>> commands = compose.commands("furrow:local");

        assertThat(commands.keySet())
                .containsExactlyInAnyOrder("control-plane", "dashboard", "replay-analytics", "simulators");
        commands.forEach((service, arguments) -> assertThat(
                        last(Furrow.commandLine(), arguments).isUsageHelpRequested())
                .as(service)
                .isFalse());
    }

    @Test
    void isReadByPinnedServiceAsByCompose() throws IOException {
        for (String name : List.of("mongo", "orion", "mosquitto", "iot-agent", "kafka")) {
            assertThat(PinnedService.of(name).image())
                    .isEqualTo(compose.services().get(name).path("image").asText());
        }
        Map<String, String> kafka = new HashMap<>();
        compose.services()
                .get("kafka")
                .path("environment")
                .properties()
                .forEach(variable ->
                        kafka.put(variable.getKey(), variable.getValue().asText()));
        assertThat(PinnedService.of("kafka").environment()).isEqualTo(kafka).isNotEmpty();
    }

    @Test
    void submitsEachJobWithExistingOptions() {
        Map<String, String> submitted = new HashMap<>();
        compose.commands("furrow-flink:local").forEach((service, arguments) -> {
            if (arguments.get(0).equals("/opt/furrow/submit")) {
                String jar = Path.of(arguments.get(2)).getFileName().toString();
                CommandLine job = last(JobCommandLine.of(JOBS.get(jar)), arguments.subList(3, arguments.size()));
                Object options = job.getCommand();
                assertThat(options).as(service).isInstanceOf(JobOptions.class);
                submitted.put(job.getCommandName(), jar);
            }
        });

        Map<String, String> jobs = new HashMap<>(Map.of("ingest", "ingest.jar", "replay", "replay.jar"));
        AnalyticsKind.jobNames().forEach(job -> jobs.put(job, "analytics.jar"));
        assertThat(submitted).isEqualTo(jobs);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "docker/connectors/ngsi-sink.json",
                "ngsi-connector/config/ngsi-sink.json",
                "ngsi-connector/config/ngsi-sink-ngsi-ld.json"
            })
    void writesTheResultsOfEachJobToTheContextBroker(String connector) throws IOException {
        JsonNode config = new ObjectMapper().readTree(Path.of("..", connector).toFile());

        assertThat(config.findValue("topics").asText().split(",")).containsAll(AnalyticsKind.topics());
    }

    @Test
    void readsTheSecretsThatInitWrites(@TempDir Path directory) throws IOException {
        Path folder = directory.resolve("secrets");
        assertThat(Furrow.commandLine().execute("init", folder.toString())).isZero();

        Set<String> read = new TreeSet<>();
        compose.services().forEach((name, service) -> {
            Set<String> mounted = new TreeSet<>();
            service.path("secrets").forEach(secret -> mounted.add(secret.asText()));
            for (String secret : ComposeFile.secrets(service)) {
                assertThat(mounted).as(name).contains(Path.of(secret).getName(0).toString());
                read.add(secret);
            }
        });
        try (Stream<Path> written = Files.walk(folder)) {
            assertThat(written.filter(Files::isRegularFile)
                            .map(file -> folder.relativize(file).toString()))
                    .containsExactlyInAnyOrderElementsOf(read);
        }
        compose.root()
                .path("secrets")
                .properties()
                .forEach(secret ->
                        assertThat(secret.getValue().path("file").asText()).isEqualTo("./secrets/" + secret.getKey()));
        assertThat(new ConnectionString(
                                Files.readString(folder.resolve("mongo/uri")).strip())
                        .getCredential())
                .isEqualTo(MongoCredential.createCredential(
                        "furrow",
                        "admin",
                        Files.readString(folder.resolve("mongo/password"))
                                .strip()
                                .toCharArray()));
    }

    @Test
    void showsNoSecretToWhoeverInspectsAContainer() {
        assertThat(compose.root().toString()).doesNotContainPattern("\\$\\{");
        compose.services()
                .forEach((name, service) -> service.path("environment")
                        .properties()
                        .forEach(variable -> assertThat(variable.getKey() + "="
                                        + variable.getValue().asText())
                                .as(name)
                                .doesNotContainPattern("(PASSWORD|SECRET|TOKEN)=(?!/run/secrets/)|://[^/@]+@")));
    }

    @Test
    void limitsMemoryLogAndRightsOfEachService() {
        compose.services().forEach((name, service) -> {
            assertThat(service.path("mem_limit").asText()).as(name).matches("\\d+[mg]");
            assertThat(service.at("/logging/options/max-size").asText())
                    .as(name)
                    .isNotEmpty();
            assertThat(service.path("cap_drop").toString()).as(name).isEqualTo("[\"ALL\"]");
            assertThat(service.path("security_opt").toString()).as(name).contains("no-new-privileges:true");
            assertThat(service.path("user").asText()).as(name).isNotIn("root", "0");
            assertThat(service.path("stop_grace_period").asText()).as(name).isEqualTo("40s");
        });
    }

    @Test
    void bindsPortsToLoopbackOnly() {
        compose.services()
                .values()
                .forEach(service -> service.path("ports")
                        .forEach(port -> assertThat(port.asText()).startsWith("127.0.0.1:")));
    }

    @Test
    void probesAndWaitsForEveryServiceThatCanBeProbed() {
        Map<String, JsonNode> services = compose.services();
        services.forEach((name, service) -> {
            if (!name.matches(ONE_SHOT) && !name.matches(UNPROBED)) {
                assertThat(service.at("/healthcheck/test")).as(name).isNotEmpty();
            }
            service.path("depends_on").properties().forEach(dependency -> {
                assertThat(services).as(name).containsKey(dependency.getKey());
                switch (dependency.getValue().path("condition").asText()) {
                    case "service_healthy" ->
                        assertThat(services.get(dependency.getKey()).has("healthcheck"))
                                .as("%s waits for %s", name, dependency.getKey())
                                .isTrue();
                    case "service_completed_successfully" ->
                        assertThat(dependency.getKey()).matches(ONE_SHOT);
                    default -> assertThat(dependency.getKey()).matches(UNPROBED);
                }
            });
        });
    }

    @Test
    void namesExistingFilesAndImagesByVersion() throws IOException {
        List<String> dockerfile = Files.readAllLines(ComposeFile.FOLDER.resolve("Dockerfile"));
        List<String> images = new ArrayList<>();
        compose.services().values().forEach(service -> {
            JsonNode build = service.path("build");
            if (build.isMissingNode()) {
                images.add(service.path("image").asText());
            } else {
                assertThat(dockerfile)
                        .anyMatch(line ->
                                line.endsWith(" AS " + build.path("target").asText()));
            }
            service.path("volumes").forEach(volume -> {
                String from = volume.asText().replaceFirst(":.*", "");
                assertThat(
                                from.startsWith("./")
                                        ? Files.isDirectory(ComposeFile.FOLDER.resolve(from))
                                        : compose.root().path("volumes").has(from))
                        .as(volume.asText())
                        .isTrue();
            });
        });
        dockerfile.stream().filter(line -> line.startsWith("FROM ")).forEach(line -> images.add(line.split(" ")[1]));
        assertThat(images).isNotEmpty().allSatisfy(image -> assertThat(image).matches("[a-z/-]+:v?\\d+(\\.\\d+)+.*"));
        dockerfile.stream()
                .filter(line -> line.startsWith("COPY ") && line.contains(" docker/"))
                .forEach(line -> assertThat(Path.of("..", line.replaceFirst(".* (docker/\\S+) .*", "$1")))
                        .exists());
        JOBS.keySet()
                .forEach(jar -> assertThat(dockerfile)
                        .as("it builds %s from the archive", jar)
                        .anyMatch(line ->
                                line.matches(".*for job in [a-z ]*\\b%s\\b.*".formatted(jar.replace(".jar", "")))));
    }

    @Test
    void configuresAWorkerOfConnect() throws IOException {
        Properties properties = new Properties();
        try (InputStream file = Files.newInputStream(ComposeFile.FOLDER.resolve("connect.properties"))) {
            properties.load(file);
        }
        Map<String, String> settings = new HashMap<>();
        properties.stringPropertyNames().forEach(name -> settings.put(name, properties.getProperty(name)));

        DistributedConfig config = new DistributedConfig(settings);

        assertThat(settings.keySet())
                .filteredOn(name ->
                        !name.startsWith("producer.") && !config.values().containsKey(name))
                .isEmpty();
        assertThat(config.exactlyOnceSourceEnabled()).isTrue();
    }

    @Test
    void startsUnderSystemdWithExistingOptions() throws IOException {
        String unit = Files.readString(Path.of("..", "suite/distribution/src/archive/systemd/furrow.service"));
        String start = unit.lines()
                .filter(line -> line.startsWith("ExecStart="))
                .findFirst()
                .orElseThrow();

        List<String> arguments = List.of(start.split(" "));
        assertThat(arguments.get(0)).isEqualTo("ExecStart=/opt/furrow/bin/furrow");
        assertThat(last(Furrow.commandLine(), arguments.subList(1, arguments.size()))
                        .getCommandName())
                .isEqualTo("up");
    }

    /** @throws CommandLine.ParameterException if an argument is unknown or its value is invalid */
    private static CommandLine last(CommandLine root, List<String> arguments) {
        List<CommandLine> parsed =
                root.parseArgs(arguments.toArray(String[]::new)).asCommandLineList();
        return parsed.get(parsed.size() - 1);
    }
}
