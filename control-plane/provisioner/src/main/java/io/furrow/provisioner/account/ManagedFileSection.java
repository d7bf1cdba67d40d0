package io.furrow.provisioner.account;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.nio.file.attribute.PosixFileAttributeView;
import java.nio.file.attribute.PosixFileAttributes;
import java.nio.file.attribute.PosixFilePermissions;
import java.util.ArrayList;
import java.util.List;
import java.util.UUID;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.file.PrivateFile;

/**
 * Reads and writes the part of a text file between two marker lines; the rest of the file belongs to others and stays
 * unchanged. The file is replaced atomically, so that it is never read half-written, not even after a power failure. It
 * keeps its permissions and, if the process may set it, its group.
 */
final class ManagedFileSection {
    private static final Logger LOG = LoggerFactory.getLogger(ManagedFileSection.class);
    private static final String BEGIN = "# Furrow: written by the control plane from here";
    private static final String END =
            "# Furrow: to here; other users belong above the first of these lines or below this one";

    private final Path file;

    ManagedFileSection(Path file) {
        this.file = file.toAbsolutePath();
    }

    /** Returns the lines of the section; empty if there is no file or no section. */
    List<String> read() throws IOException {
        List<String> all = lines();
        int begin = all.indexOf(BEGIN);
        return begin < 0 ? List.of() : List.copyOf(all.subList(begin + 1, end(all, begin)));
    }

    /** Returns the lines before and after the section. */
    List<String> readOthers() throws IOException {
        List<String> all = lines();
        int begin = all.indexOf(BEGIN);
        if (begin < 0) {
            return all;
        }
        List<String> others = new ArrayList<>(all.subList(0, begin));
        others.addAll(all.subList(Math.min(all.size(), end(all, begin) + 1), all.size()));
        return others;
    }

    void write(List<String> section) throws IOException {
        List<String> all = lines();
        int begin = all.indexOf(BEGIN);
        List<String> next = new ArrayList<>(begin < 0 ? all : all.subList(0, begin));
        next.add(BEGIN);
        next.addAll(section);
        next.add(END);
        if (begin >= 0) {
            next.addAll(all.subList(Math.min(all.size(), end(all, begin) + 1), all.size()));
        }
        Path target = Files.exists(file) ? file.toRealPath() : file; // preserves a symbolic link
        Files.createDirectories(target.getParent());
        Path fresh = target.resolveSibling(target.getFileName() + "." + UUID.randomUUID() + ".new");
        try {
            PrivateFile.create(fresh, String.join("\n", next) + "\n");
            copyPermissionsTo(fresh);
            Files.move(fresh, target, StandardCopyOption.ATOMIC_MOVE, StandardCopyOption.REPLACE_EXISTING);
        } finally {
            Files.deleteIfExists(fresh);
        }
    }

    private List<String> lines() throws IOException {
        return Files.exists(file) ? Files.readAllLines(file) : List.of();
    }

    private static int end(List<String> all, int begin) {
        int end = all.indexOf(END);
        return end < begin ? all.size() : end;
    }

    /** Gives the new file the permissions and group of the old one; without an old one its owner and group may read it. */
    private void copyPermissionsTo(Path fresh) throws IOException {
        PosixFileAttributeView view = Files.getFileAttributeView(fresh, PosixFileAttributeView.class);
        if (view == null) {
            return;
        }
        if (!Files.exists(file)) {
            view.setPermissions(PosixFilePermissions.fromString("rw-r-----"));
            return;
        }
        PosixFileAttributes old = Files.readAttributes(file, PosixFileAttributes.class);
        try {
            if (!old.group().equals(view.readAttributes().group())) {
                view.setGroup(old.group());
            }
        } catch (IOException e) {
            LOG.warn(
                    "{} does not keep its group {}; members of that group can no longer read it", file, old.group(), e);
        }
        view.setPermissions(old.permissions());
    }

    @Override
    public String toString() {
        return file.toString();
    }
}
