package io.furrow.launcher.command;

import java.io.IOException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Path;
import java.security.SecureRandom;
import java.util.Base64;
import java.util.HexFormat;
import java.util.List;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

import io.furrow.cli.CommandException;
import io.furrow.cli.option.HelpOption;
import io.furrow.model.file.PrivateFile;

/** {@code ./furrow init}. */
@Command(
        name = "init",
        description = {
            "Makes the secrets of a farm in containers: a file of environment variables for docker/compose.yaml.",
            "Only its owner may read it; one that is there already stays as it is."
        })
public final class InitCommand implements Callable<Integer> {
    /** Made of letters and digits alone, so that they need no quotes in a URI, a shell or a properties file. */
    private static final List<String> PASSWORDS = List.of("MONGO_PASSWORD", "MQTT_PASSWORD", "ADMIN_TOKEN");

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
            throw new CommandException("%s cannot be written (%s)".formatted(file, e), e);
        }
        spec.commandLine()
                .getOut()
                .printf("%s holds new secrets. Keep a copy in a safe place: FARM_SECRET is in every device.%n", file);
        spec.commandLine().getOut().flush();
        return 0;
    }

    private static String variables() {
        SecureRandom random = new SecureRandom();
        StringBuilder text = new StringBuilder(
                "FARM_SECRET=%s%n".formatted(Base64.getEncoder().encodeToString(bytes(random, SECRET_BYTES))));
        for (String password : PASSWORDS) {
            text.append("%s=%s%n".formatted(password, HexFormat.of().formatHex(bytes(random, PASSWORD_BYTES))));
        }
        return text.toString();
    }

    private static byte[] bytes(SecureRandom random, int count) {
        byte[] bytes = new byte[count];
        random.nextBytes(bytes);
        return bytes;
    }
}
