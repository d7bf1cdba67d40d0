package io.furrow.launcher;

import java.io.IOException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.FileAttribute;
import java.nio.file.attribute.PosixFilePermissions;
import java.security.SecureRandom;
import java.util.Base64;

import io.furrow.model.device.FarmSecret;

/** The file of a farm's secret; where there is none one is made that only its owner can read. */
final class FarmSecretFile {
    private static final int BYTES = 32;

    private FarmSecretFile() {}

    /** @throws SuiteNotStartedException if it cannot be read or made, or holds too little */
    static FarmSecret readOrMake(Path file) {
        try {
            if (!Files.exists(file)) {
                make(file);
            }
            return FarmSecret.read(file);
        } catch (IOException e) {
            throw new SuiteNotStartedException(
                    "The farm's secret cannot be used: %s. Name a file with --farm-secret.".formatted(e.getMessage()),
                    e);
        }
    }

    private static void make(Path file) throws IOException {
        byte[] secret = new byte[BYTES];
        new SecureRandom().nextBytes(secret);
        FileAttribute<?>[] forItsOwner =
                file.getFileSystem().supportedFileAttributeViews().contains("posix")
                        ? new FileAttribute<?>[] {
                            PosixFilePermissions.asFileAttribute(PosixFilePermissions.fromString("rw-------"))
                        }
                        : new FileAttribute<?>[0];
        try {
            Files.createFile(file, forItsOwner);
        } catch (FileAlreadyExistsException e) {
            return; // made by somebody else in this moment
        }
        Files.writeString(file, Base64.getEncoder().encodeToString(secret) + "\n");
    }
}
