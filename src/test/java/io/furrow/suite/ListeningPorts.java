package io.furrow.suite;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.util.Set;
import java.util.TreeSet;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

import io.furrow.files.Folders;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Lists the TCP ports on which this JVM listens, as reported by the operating system. */
final class ListeningPorts {
    private static final Path PROC = Path.of("/proc/self");
    private static final String LISTENING = "0A";
    private static final Pattern LSOF_NAME = Pattern.compile("n.*:(\\d+)");

    private ListeningPorts() {}

    /** @throws IllegalStateException if neither {@code /proc} nor {@code lsof} reports any */
    static Set<Integer> ofThisJvm() throws IOException, InterruptedException {
        Set<Integer> ports = Files.isDirectory(PROC.resolve("fd")) ? fromProc() : fromLsof();
        if (ports.isEmpty()) {
            throw new IllegalStateException("this JVM listens on no TCP port; were they listed before a server ran?");
        }
        return ports;
    }

    /** Linux: listening sockets with a file descriptor of this process. */
    private static Set<Integer> fromProc() throws IOException {
        Set<String> own = inodesOfThisProcess();
        Set<Integer> ports = new TreeSet<>();
        for (String table : new String[] {"net/tcp", "net/tcp6"}) {
            Path file = PROC.resolve(table);
            if (!Files.exists(file)) {
                continue;
            }
            for (String line : Files.readAllLines(file)) {
                String[] columns = line.strip().split("\\s+");
                if (columns.length > 9 && columns[3].equals(LISTENING) && own.contains(columns[9])) {
                    ports.add(Integer.parseInt(columns[1].substring(columns[1].lastIndexOf(':') + 1), 16));
                }
            }
        }
        return ports;
    }

    private static Set<String> inodesOfThisProcess() throws IOException {
        return Folders.list(PROC.resolve("fd")).stream()
                .map(ListeningPorts::target)
                .filter(target -> target.startsWith("socket:["))
                .map(target -> target.substring("socket:[".length(), target.length() - 1))
                .collect(Collectors.toSet());
    }

    /** Empty for a descriptor that was closed meanwhile. */
    private static String target(Path descriptor) {
        try {
            return Files.readSymbolicLink(descriptor).toString();
        } catch (NoSuchFileException e) {
            return "";
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /** Other systems, for instance macOS. */
    private static Set<Integer> fromLsof() throws IOException, InterruptedException {
        String pid = Long.toString(ProcessHandle.current().pid());
        Process lsof = new ProcessBuilder("lsof", "-a", "-p", pid, "-iTCP", "-sTCP:LISTEN", "-n", "-P", "-Fn").start();
        String printed = new String(lsof.getInputStream().readAllBytes(), UTF_8);
        lsof.waitFor();
        return printed.lines()
                .map(LSOF_NAME::matcher)
                .filter(java.util.regex.Matcher::matches)
                .map(name -> Integer.valueOf(name.group(1)))
                .collect(Collectors.toCollection(TreeSet::new));
    }
}
