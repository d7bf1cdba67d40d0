package io.furrow.launcher.command;

import java.io.IOException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;
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
            "Generates the secrets of a farm in containers: a folder of files for docker/compose.yaml.",
            "Only its owner may enter it; an existing folder is not changed."
        })
public final class InitCommand implements Callable<Integer> {
    private static final SecureRandom RANDOM = new SecureRandom();
    private static final int SECRET_BYTES = 32;
    private static final int PASSWORD_BYTES = 24;

    @Spec
    private CommandSpec spec;

    @Parameters(
            paramLabel = "FOLDER",
            arity = "0..1",
            defaultValue = "secrets",
            description = "The folder. Default: ${DEFAULT-VALUE}.")
    private Path folder;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() {
        try {
            Files.createDirectory(folder);
            permit(folder, "rwx------");
            String mongo = password();
            write("api/tokens", "admin %s admin".formatted(password()));
            write("farm/secret", Base64.getEncoder().encodeToString(bytes(SECRET_BYTES)));
            write("mongo/password", mongo);
            write("mongo/uri", "mongodb://furrow:%s@mongo:27017/?authSource=admin".formatted(mongo));
            write("mqtt/password", password());
        } catch (FileAlreadyExistsException e) {
            throw new CommandException(
                    folder + " is there already and stays as it is: running containers have its secrets.", e);
        } catch (IOException e) {
            throw new CommandException("%s cannot be written (%s)".formatted(folder, FileProblem.of(e)), e);
        }
        spec.commandLine()
                .getOut()
                .printf("%s holds new secrets. Keep a copy in a safe place: farm/secret is in every device.%n", folder);
        spec.commandLine().getOut().flush();
        return 0;
    }

    /** Containers have other users, who may read what is mounted from the folder. */
    private void write(String name, String text) throws IOException {
        Path file = folder.resolve(name);
        Files.createDirectories(file.getParent());
        permit(file.getParent(), "rwxr-xr-x");
        PrivateFile.create(file, text + "\n");
        permit(file, "rw-r--r--");
    }

    private static void permit(Path path, String permissions) throws IOException {
        if (path.getFileSystem().supportedFileAttributeViews().contains("posix")) {
            Files.setPosixFilePermissions(path, PosixFilePermissions.fromString(permissions));
        }
    }

    /** Consists of digits and letters only, so that it needs no quotes in a URI. */
    private static String password() {
        return HexFormat.of().formatHex(bytes(PASSWORD_BYTES));
    }

    private static byte[] bytes(int count) {
        byte[] bytes = new byte[count];
        RANDOM.nextBytes(bytes);
        return bytes;
    }
}
