package io.furrow.cli.control;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.Commands;
import io.furrow.control.ControlPlane;
import io.furrow.control.ControlSettings;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.control.rest.access.CertificateFiles;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.SelfSignedCertificate;
import io.furrow.kafka.Readiness;
import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

/** Commands with a control plane on a Kafka of their own. */
abstract class CommandsOnControlPlane {
    @TempDir
    static Path directory;

    static EmbeddedKafka kafka;
    static ControlPlane plane;
    static RestApi api;
    static SelfSignedCertificate certificate;
    static FarmSecret secret;

    final StringWriter out = new StringWriter();
    final StringWriter err = new StringWriter();

    @BeforeAll
    static void start() throws Exception {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        Properties client = kafka.client();
        ControlSettings settings = ControlSettings.of(client);
        plane = ControlPlane.start(settings);
        Path tokens = Files.writeString(directory.resolve("tokens"), "ann a-token-of-some-length admin\n");
        certificate = SelfSignedCertificate.make(directory, "control-plane");
        secret = FarmSecret.generate();
        RestSettings rest = RestSettings.on(0)
                .withTokens(tokens)
                .withCertificate(CertificateFiles.pem(certificate.certificate(), certificate.key()))
                .withSecret(SecretSource.of(secret));
        api = RestApi.start(settings, rest, new Readiness(Clock.systemUTC()));
        Files.writeString(directory.resolve("token"), "a-token-of-some-length\n");
    }

    @AfterAll
    static void stop() {
        api.close();
        plane.close();
        kafka.close();
    }

    JsonNode json(String... arguments) throws Exception {
        List<String> all = new ArrayList<>(List.of(arguments));
        all.addAll(List.of("--output", "json"));
        return NgsiJson.read(run(all.toArray(new String[0])).getBytes(java.nio.charset.StandardCharsets.UTF_8));
    }

    String run(String... arguments) {
        out.getBuffer().setLength(0);
        assertThat(furrow().execute(withAccess(arguments))).as("%s", err).isZero();
        return out.toString();
    }

    String onKafka(String... arguments) {
        out.getBuffer().setLength(0);
        List<String> all = new ArrayList<>(List.of(arguments));
        all.addAll(List.of("--kafka", kafka.bootstrapServers()));
        assertThat(furrow().execute(all.toArray(String[]::new))).as("%s", err).isZero();
        return out.toString();
    }

    String refused(String... arguments) {
        err.getBuffer().setLength(0);
        assertThat(furrow().execute(withAccess(arguments))).as("%s", out).isNotZero();
        return err.toString();
    }

    private static String[] withAccess(String... arguments) {
        List<String> all = new ArrayList<>(List.of(arguments));
        all.addAll(List.of(
                "--api", api.uri().toString(),
                "--api-ca", certificate.certificate().toString(),
                "--token-file", directory.resolve("token").toString()));
        return all.toArray(new String[0]);
    }

    CommandLine furrow() {
        return Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL)
                .setOut(new PrintWriter(out, true))
                .setErr(new PrintWriter(err, true));
    }
}
