package io.furrow.launcher.status;

import java.io.ByteArrayOutputStream;
import java.io.IOError;
import java.io.IOException;
import java.io.PrintStream;
import java.nio.charset.Charset;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.function.IntFunction;
import java.util.stream.Collectors;

import org.jline.terminal.Attributes;
import org.jline.terminal.Attributes.LocalFlag;
import org.jline.terminal.Size;
import org.jline.terminal.Terminal;
import org.jline.terminal.Terminal.Signal;
import org.jline.terminal.TerminalBuilder;
import org.jline.utils.AttributedString;
import org.jline.utils.Display;
import org.jline.utils.InfoCmp.Capability;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Draws lines over a whole terminal, cut to its width, and redraws when its size changes. It uses the alternate screen, so that the
 * previous content returns and no scrollback is left. Output of other threads is printed when it is closed.
 */
public final class StatusScreen implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(StatusScreen.class);
    private static final Size UNKNOWN = new Size(80, 24);
    private static final Path PROCESS = Path.of("/proc/self/stat");

    private final Terminal terminal;
    private final Attributes before;
    private final PrintStream out = System.out;
    private final PrintStream err = System.err;
    private final ByteArrayOutputStream printed = new ByteArrayOutputStream();
    private IntFunction<List<String>> block = rows -> List.of();
    private Display display;
    private Size size;
    private boolean closed;

    /** @param terminal closed with this */
    StatusScreen(Terminal terminal) {
        this.terminal = terminal;
        this.before = terminal.getAttributes();
        Attributes silent = new Attributes(before);
        silent.setLocalFlag(LocalFlag.ECHO, false);
        terminal.setAttributes(silent);
        PrintStream retained = new PrintStream(printed, true, Charset.defaultCharset());
        System.setOut(retained);
        System.setErr(retained);
        terminal.puts(Capability.enter_ca_mode);
        terminal.puts(Capability.cursor_invisible);
        terminal.handle(Signal.WINCH, signal -> begin());
        begin();
    }

    /** Null if the output is not a terminal that can be redrawn, or belongs to another process because this one runs in the background. */
    public static StatusScreen open() throws IOException {
        if (System.console() == null || isInBackground()) {
            return null;
        }
        // The JVM handles Ctrl-C.
        Terminal terminal = TerminalBuilder.builder()
                .system(true)
                .dumb(true)
                .nativeSignals(false)
                .build();
        if (terminal.getType().startsWith(Terminal.TYPE_DUMB)) {
            terminal.close();
            return null;
        }
        return new StatusScreen(terminal);
    }

    /** Compares process groups, which Linux reports for a terminal. */
    private static boolean isInBackground() throws IOException {
        if (!Files.isReadable(PROCESS)) {
            return false;
        }
        String[] fields =
                Files.readString(PROCESS).replaceFirst("(?s).*\\) ", "").split(" ");
        return !fields[2].equals(fields[5]);
    }

    /** @param lines returns at most the given number of rows */
    synchronized void show(IntFunction<List<String>> lines) {
        block = lines;
        draw();
    }

    private synchronized void begin() {
        if (!closed) {
            Size now = terminal.getSize();
            size = now.getRows() <= 0 || now.getColumns() <= 0 ? UNKNOWN : now;
            terminal.puts(Capability.clear_screen);
            display = new Display(terminal, true);
            display.resize(size.getRows(), size.getColumns());
            draw();
        }
    }

    private void draw() {
        if (!closed) {
            List<AttributedString> lines = block.apply(size.getRows()).stream()
                    .limit(size.getRows())
                    .map(line -> new AttributedString(line).columnSubSequence(0, size.getColumns() - 1))
                    .collect(Collectors.toCollection(ArrayList::new));
            display.update(lines, -1); // changes the list where it scrolls
            terminal.flush();
        }
    }

    /** Restores the terminal. Idempotent and thread-safe. */
    @Override
    public synchronized void close() {
        if (closed) {
            return;
        }
        closed = true;
        System.setOut(out);
        System.setErr(err);
        terminal.puts(Capability.cursor_normal);
        terminal.puts(Capability.exit_ca_mode);
        terminal.flush();
        try {
            terminal.setAttributes(before);
            terminal.close();
        } catch (IOException | IOError e) { // of a closed terminal
            LOG.debug("the terminal could not be restored", e);
        }
        err.print(printed.toString(Charset.defaultCharset()));
        err.flush();
    }
}
