package io.furrow.launcher.command;

import java.io.IOException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.CommandGroup;
import io.furrow.cli.option.OutputOptions;
import io.furrow.cli.time.Times;
import io.furrow.launcher.suite.FarmSecretFile;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.FarmSecretCodec;
import io.furrow.model.file.FileProblem;
import io.furrow.model.file.PrivateFile;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow secret}. */
@Command(
        name = "secret",
        description = "Creates and rotates the farm's secret, from which the credentials of all devices are derived.",
        synopsisSubcommandLabel = "COMMAND")
public final class SecretCommandGroup extends CommandGroup {
    private static final String FILE = "File of the farm's secret.";

    @Spec
    private CommandSpec spec;

    @Command(name = "new", description = "Creates the secret of a new farm in a file that only its owner may read.")
    int create(@Parameters(paramLabel = "FILE", description = FILE) Path file) {
        try {
            FarmSecret secret = FarmSecretFile.make(file);
            print("%s holds a new secret with the fingerprint %s.".formatted(file, secret.fingerprint()));
            print(
                    "Give a copy to every process of the farm, and keep one in a safe place: without it all devices need new credentials.");
            return 0;
        } catch (FileAlreadyExistsException e) {
            return refuse(
                    file + " is there already and stays as it is; ./furrow secret rotate gives a farm another key", e);
        } catch (IOException e) {
            return refuse("%s cannot be written (%s)".formatted(file, FileProblem.of(e)), e);
        }
    }

    @Command(name = "show", description = "Shows fingerprints and times of the keys of a secret, not the keys.")
    int show(@Parameters(paramLabel = "FILE", description = FILE) Path file, @Mixin OutputOptions output)
            throws IOException {
        FarmSecret secret = read(file);
        Instant now = Instant.now();
        ArrayNode keys = NgsiJson.array();
        List<String> lines = new ArrayList<>();
        for (FarmSecret.KeyInfo key : secret.describe()) {
            ObjectNode json = keys.addObject().put("key", key.number()).put("fingerprint", key.fingerprint());
            json.put("makesPasswords", key.until() == null).put("makesApiKeys", key.makesApiKeys());
            String passwords = "makes passwords";
            if (key.until() != null) {
                json.put("acceptedUntil", key.until().toString());
                passwords = key.until().isAfter(now)
                        ? "its passwords are accepted until " + Times.of(json.path("acceptedUntil"))
                        : "its passwords are no longer accepted";
            }
            lines.add("key %d  %s  %s%s"
                    .formatted(
                            key.number(), key.fingerprint(), passwords, key.makesApiKeys() ? ", makes API keys" : ""));
        }
        List<String> names =
                secret.describe().stream().map(FarmSecret.KeyInfo::fingerprint).toList();
        output.print(spec.commandLine().getOut(), keys, lines, names);
        return 0;
    }

    @Command(
            name = "rotate",
            description = {
                "Adds a key for new passwords; those of the previous key are accepted for a time.",
                "Running processes read the file again when it changes."
            })
    int rotate(
            @Parameters(paramLabel = "FILE", description = FILE) Path file,
            @Option(
                            names = "--keep-old",
                            paramLabel = "DURATION",
                            description =
                                    "How long the old passwords are accepted, such as 30d or 12h; 0s for not at all. Default: 30d, "
                                            + "with --api-keys 0s.")
                    Duration retainOld,
            @Option(
                            names = "--api-keys",
                            description =
                                    "Also create new API keys. They are part of the MQTT topics: measures of a device are lost until it "
                                            + "has its new credentials.")
                    boolean apiKeys) {
        if (apiKeys && retainOld != null && !retainOld.isZero()) {
            throw new ParameterException(
                    spec.commandLine(), "with --api-keys the old credentials are of no use; leave --keep-old out");
        }
        FarmSecret secret = read(file);
        Duration retained = retainOld == null ? apiKeys ? Duration.ZERO : Duration.ofDays(30) : retainOld;
        Instant now = Instant.now().truncatedTo(ChronoUnit.SECONDS);
        FarmSecret rotated = secret.rotated(now, now.plus(retained), apiKeys);
        try {
            PrivateFile.replace(file, FarmSecretCodec.write(rotated));
        } catch (IOException e) {
            return refuse("%s cannot be replaced (%s); it is as it was".formatted(file, FileProblem.of(e)), e);
        }
        print("%s holds key %d with the fingerprint %s.".formatted(file, rotated.newestKey(), rotated.fingerprint()));
        print(
                retained.isZero()
                        ? "Passwords of key %d are refused from now on.".formatted(secret.newestKey())
                        : "Passwords of key %d are accepted until %s."
                                .formatted(
                                        secret.newestKey(),
                                        Times.of(now.plus(retained).toEpochMilli())));
        print(
                "Give a copy to every process of the farm, the control plane first; then give each device its new credentials: ./furrow device credentials DEVICE");
        return 0;
    }

    private static FarmSecret read(Path file) {
        try {
            return FarmSecret.read(file);
        } catch (IOException e) {
            throw new CommandException(e.getMessage(), e);
        }
    }

    private void print(String line) {
        spec.commandLine().getOut().println(line);
        spec.commandLine().getOut().flush();
    }

    private static int refuse(String message, IOException cause) {
        throw new CommandException(message, cause);
    }
}
