package io.furrow.connect.repair;

import java.io.BufferedWriter;
import java.io.IOException;
import java.nio.charset.CharacterCodingException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.nio.file.StandardOpenOption;
import java.util.HashSet;
import java.util.Optional;
import java.util.Set;

/**
 * The entities of one tenant that are on the topic and were not deleted since, so that one that is gone from the context broker
 * can be told. Outlives a restart in a file of lines, {@code +identity} and {@code -identity}, which is written anew at each
 * start; line breaks in an id are escaped, a line that was not finished is left out. Of more than {@code most} entities none is
 * known any more, because a part of them would not show which are gone.
 */
final class KnownEntities implements AutoCloseable {
    private final Path file;
    private final int most;
    private final Set<String> identities = new HashSet<>();
    private BufferedWriter log;
    private boolean tooMany;

    private KnownEntities(Path file, int most) {
        this.file = file;
        this.most = most;
    }

    static KnownEntities open(Path file, int most) throws IOException {
        KnownEntities known = new KnownEntities(file, most);
        known.read();
        known.rewrite();
        return known;
    }

    private void read() throws IOException {
        if (!Files.exists(file)) {
            return;
        }
        String text;
        try {
            text = Files.readString(file);
        } catch (CharacterCodingException e) { // not ours any more: as good as none
            text = "";
        }
        String whole = text.substring(0, text.lastIndexOf('\n') + 1);
        whole.lines().forEach(line -> {
            if (line.startsWith("+")) {
                Optional.of(unescaped(line.substring(1)))
                        .filter(Identities::isOne)
                        .ifPresent(this::keep);
            } else if (line.startsWith("-")) {
                identities.remove(unescaped(line.substring(1)));
            } else if (line.equals("!")) {
                giveUp();
            }
        });
    }

    private void rewrite() throws IOException {
        Path next = file.resolveSibling(file.getFileName() + ".tmp");
        try (BufferedWriter out = Files.newBufferedWriter(next, StandardCharsets.UTF_8)) {
            for (String identity : identities) {
                out.write("+" + escaped(identity) + "\n");
            }
            if (tooMany) {
                out.write("!\n");
            }
        }
        Files.move(next, file, StandardCopyOption.REPLACE_EXISTING, StandardCopyOption.ATOMIC_MOVE);
        log = Files.newBufferedWriter(file, StandardCharsets.UTF_8, StandardOpenOption.APPEND);
    }

    /** Line breaks and backslashes as {@code \n}, {@code \r} and {@code \\}. */
    private static String escaped(String identity) {
        return identity.replace("\\", "\\\\").replace("\n", "\\n").replace("\r", "\\r");
    }

    private static String unescaped(String line) {
        StringBuilder identity = new StringBuilder(line.length());
        for (int i = 0; i < line.length(); i++) {
            char sign = line.charAt(i);
            if (sign == '\\' && i + 1 < line.length()) {
                char next = line.charAt(++i);
                sign = next == 'n' ? '\n' : next == 'r' ? '\r' : next;
            }
            identity.append(sign);
        }
        return identity.toString();
    }

    private boolean keep(String identity) {
        if (tooMany || !identities.add(identity)) {
            return false;
        }
        if (identities.size() > most) {
            giveUp();
        }
        return true;
    }

    private void giveUp() {
        tooMany = true;
        identities.clear();
    }

    synchronized void add(String identity) throws IOException {
        if (keep(identity)) {
            log.write(tooMany ? "!\n" : "+" + escaped(identity) + "\n");
        }
    }

    synchronized void remove(String identity) throws IOException {
        if (identities.remove(identity)) {
            log.write("-" + escaped(identity) + "\n");
        }
    }

    /** Hands what was noted to the operating system. */
    synchronized void flush() throws IOException {
        log.flush();
    }

    /** Whether there are more than can be known. */
    synchronized boolean isOverfull() {
        return tooMany;
    }

    synchronized int size() {
        return identities.size();
    }

    synchronized boolean contains(String identity) {
        return identities.contains(identity);
    }

    /** As they are now, in a set of its own. */
    synchronized Set<String> copy() {
        return new HashSet<>(identities);
    }

    @Override
    public synchronized void close() throws IOException {
        log.close();
    }
}
