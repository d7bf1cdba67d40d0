package io.furrow.launcher.command;

import java.io.IOException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Path;
import java.security.SecureRandom;
import java.util.Base64;
import java.util.HexFormat;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.HelpOption;
import io.furrow.model.file.FileProblem;
import io.furrow.model.file.PrivateFile;

/** {@code ./furrow init}. */
@Command(
        name = "init",
        description = {
            "Generates the secrets of a farm in containers: a file of environment variables for "
                    + "docker/compose.yaml.",
            "Only its owner may read it; an existing file is not changed."
        })
public final class InitCommand implements Callable<Integer> {
    private static final SecureRandom RANDOM = new SecureRandom();
    private static final int SECRET_BYTES = 32;
    private static final int PASSWORD_BYTES = 24;

    @Spec
    private CommandSpec spec;

    @Parameters(
            paramLabel = "FILE",
            arity = "0..1",
            defaultValue = ".env",
            description = "The file. Default: ${DEFAULT-VALUE}.")
    private Path file;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() {
        try {
            PrivateFile.create(file, variables());
        } catch (FileAlreadyExistsException e) {
            throw new CommandException(
                    file + " is there already and stays as it is: running containers have its secrets.", e);
        } catch (IOException e) {
            throw new CommandException("%s cannot be written (%s)".formatted(file, FileProblem.of(e)), e);
        }
        spec.commandLine()
                .getOut()
                .printf("%s holds new secrets. Keep a copy in a safe place: FARM_SECRET is in every device.%n", file);
        spec.commandLine().getOut().flush();
        return 0;
    }

    /** Passwords consist of digits and letters only, so that they need no quotes in a URI. */
    private static String variables() {
        return """
                FARM_SECRET=%s
                MONGO_PASSWORD=%s
                MQTT_PASSWORD=%s
                API_TOKENS="admin %s admin"
                """.formatted(
                        Base64.getEncoder().encodeToString(bytes(SECRET_BYTES)), password(), password(), password());
    }

    private static String password() {
        return HexFormat.of().formatHex(bytes(PASSWORD_BYTES));
    }

    private static byte[] bytes(int count) {
        byte[] bytes = new byte[count];
        RANDOM.nextBytes(bytes);
        return bytes;
    }
}
