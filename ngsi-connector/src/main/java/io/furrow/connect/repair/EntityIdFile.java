package io.furrow.connect.repair;

import java.io.BufferedReader;
import java.io.BufferedWriter;
import java.io.IOException;
import java.io.RandomAccessFile;
import java.nio.charset.CharacterCodingException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.nio.file.StandardOpenOption;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import java.util.regex.Pattern;

/**
 * What is known of entities as a file of lines: {@code +identity}, {@code -identity}, {@code !} where there are too many;
 * {@code ?identity} of one that is stale, {@code .} where none is stale any more. Line breaks and the percent sign are
 * percent-encoded. A line that was not finished is left out. Locks are the caller's.
 */
final class EntityIdFile implements AutoCloseable {
    /** Half a surrogate pair, which JSON can contain and UTF-8 cannot. */
    private static final Pattern HALF = Pattern.compile("[\\x{D800}-\\x{DFFF}]");

    private static final Pattern HALF_WRITTEN = Pattern.compile("%u([0-9A-F]{4})");

    private static final long SMALL = 1024 * 1024;

    /** A line. */
    record Change(Kind kind, String identity) {
        static final Change TOO_MANY = new Change(Kind.TOO_MANY, "");
        static final Change SETTLED = new Change(Kind.SETTLED, "");

        /** The first character of a line. */
        enum Kind {
            ADDED('+'),
            REMOVED('-'),
            STALE('?'),
            SETTLED('.'),
            TOO_MANY('!');

            private final char sign;

            Kind(char sign) {
                this.sign = sign;
            }
        }

        static Change added(String identity) {
            return new Change(Kind.ADDED, identity);
        }

        static Change removed(String identity) {
            return new Change(Kind.REMOVED, identity);
        }

        static Change stale(String identity) {
            return new Change(Kind.STALE, identity);
        }

        private String line() {
            String text = identity.replace("%", "%25").replace("\n", "%0A").replace("\r", "%0D");
            return kind.sign
                    + HALF.matcher(text)
                            .replaceAll(half -> "%%u%04X".formatted(half.group().codePointAt(0))) + "\n";
        }

        private static boolean isOne(String line) {
            return line.equals("!") || line.equals(".") || line.matches("[-+?][^|]*\\|[^|]*\\|[^|]*\\|.*");
        }

        private static Change of(String line) {
            String identity = HALF_WRITTEN
                    .matcher(line.substring(1))
                    .replaceAll(half -> Character.toString(Integer.parseInt(half.group(1), 16)))
                    .replace("%0A", "\n")
                    .replace("%0D", "\r")
                    .replace("%25", "%");
            return switch (line.charAt(0)) {
                case '+' -> added(identity);
                case '-' -> removed(identity);
                case '?' -> stale(identity);
                case '.' -> SETTLED;
                default -> TOO_MANY;
            };
        }
    }

    private final Path path;
    private BufferedWriter out;
    private long chars;
    /** Changes that arrive while the file is compacted; else null. */
    private List<Change> meanwhile;

    private EntityIdFile(Path path) {
        this.path = path;
    }

    /** Passes all complete lines in order; none if the file has another format. */
    static void read(Path path, Consumer<Change> reader) throws IOException {
        if (!Files.exists(path)) {
            return;
        }
        List<String> last = new ArrayList<>();
        try (BufferedReader in = Files.newBufferedReader(path)) {
            for (String line = in.readLine(); line != null; line = in.readLine()) {
                last.forEach(before -> reader.accept(Change.of(before)));
                last.clear();
                if (Change.isOne(line)) {
                    last.add(line);
                }
            }
        } catch (CharacterCodingException e) {
            return; // not ours any more, from here on
        }
        if (endsWithLine(path)) {
            last.forEach(before -> reader.accept(Change.of(before)));
        }
    }

    private static boolean endsWithLine(Path path) throws IOException {
        try (RandomAccessFile file = new RandomAccessFile(path.toFile(), "r")) {
            if (file.length() == 0) {
                return false;
            }
            file.seek(file.length() - 1);
            return file.read() == '\n';
        }
    }

    /** Creates the file with exactly these lines. */
    static EntityIdFile write(Path path, Iterable<Change> changes) throws IOException {
        EntityIdFile file = new EntityIdFile(path);
        file.beginRewrite();
        file.writeAside(changes);
        file.endRewrite();
        return file;
    }

    void append(Change change) throws IOException {
        String line = change.line();
        out.write(line);
        chars += line.length();
        if (meanwhile != null) {
            meanwhile.add(change);
        }
    }

    void flush() throws IOException {
        out.flush();
    }

    /** Whether the file is several times larger than necessary. */
    boolean isWasteful(long bytes) {
        return meanwhile == null && chars > SMALL && chars > 2 * bytes;
    }

    void beginRewrite() {
        meanwhile = new ArrayList<>();
    }

    /** May run while changes are appended. */
    void writeAside(Iterable<Change> changes) throws IOException {
        try (BufferedWriter next = Files.newBufferedWriter(aside())) {
            for (Change change : changes) {
                next.write(change.line());
            }
        }
    }

    void endRewrite() throws IOException {
        BufferedWriter before = out;
        BufferedWriter next = Files.newBufferedWriter(aside(), StandardCharsets.UTF_8, StandardOpenOption.APPEND);
        try {
            for (Change change : meanwhile) {
                next.write(change.line());
            }
            next.flush();
            Files.move(aside(), path, StandardCopyOption.REPLACE_EXISTING, StandardCopyOption.ATOMIC_MOVE);
        } catch (IOException e) {
            next.close();
            throw e;
        }
        out = next;
        meanwhile = null;
        chars = Files.size(path);
        if (before != null) {
            before.close();
        }
    }

    /** Keeps the file as it is; for instance because the disk is full. */
    void abandonRewrite() {
        meanwhile = null;
    }

    private Path aside() {
        return path.resolveSibling(path.getFileName() + ".tmp");
    }

    @Override
    public void close() throws IOException {
        out.close();
    }
}
