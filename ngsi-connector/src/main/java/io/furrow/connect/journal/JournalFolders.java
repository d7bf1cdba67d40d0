package io.furrow.connect.journal;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.AccessDeniedException;
import java.nio.file.FileStore;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.security.SecureRandom;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HexFormat;
import java.util.List;
import java.util.Optional;
import java.util.function.Consumer;
import java.util.regex.Pattern;
import java.util.stream.Stream;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * The journals of one owner below a folder that several owners share: {@code <root>/<owner>/<slot>-<random>}. A slot is a
 * number that distinguishes journals that are in use at the same time.
 */
public final class JournalFolders {
    private static final Logger LOG = LoggerFactory.getLogger(JournalFolders.class);
    private static final Pattern NAME = Pattern.compile("\\d+-[0-9a-f]{16}");
    private static final SecureRandom RANDOM = new SecureRandom();

    /**
     * A journal that holds records and that no task has open.
     *
     * @param owner by the name of its folder
     * @param bytes of its files
     */
    public record Orphan(String owner, Path folder, long bytes) {}

    private final Path root;
    private final String owner;
    private final Path own;
    private final JournalSettings settings;

    /** @param root is created if missing */
    public JournalFolders(Path root, String owner, JournalSettings settings) {
        this.root = root;
        this.owner = owner;
        this.own = root.resolve(folderName(owner));
        this.settings = settings;
    }

    /** The owner of the journals. */
    public String owner() {
        return owner;
    }

    /**
     * The first journal of a slot that no task has open, or a new one.
     *
     * @throws UncheckedIOException if the folder cannot be used
     */
    public Journal take(int slot) {
        try {
            create(own, DurableFiles::syncFolder);
            DurableFiles.syncFolder(own);
            for (Path folder : foldersOf(own)) {
                if (folder.getFileName().toString().startsWith(slot + "-")) {
                    Optional<Journal> journal = openUnlessDeleted(folder);
                    if (journal.isPresent()) {
                        return journal.get();
                    }
                }
            }
            return made(slot);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot use the folder " + own, e);
        }
    }

    /** Makes the names in a folder durable: a name is durable once its parent folder was synced. */
    interface Sync {
        void of(Path folder) throws IOException;
    }

    /**
     * Creates a folder and its missing parents, and syncs all parents up to the root of the file system: a process that
     * died may have left any of them unsynced. An unreadable parent existed before.
     */
    static void create(Path folder, Sync sync) throws IOException {
        Files.createDirectories(folder);
        FileStore store = Files.getFileStore(folder);
        Path above = folder.toAbsolutePath().getParent();
        try {
            while (above != null && Files.getFileStore(above).equals(store)) {
                sync.of(above);
                above = above.getParent();
            }
        } catch (AccessDeniedException e) {
            // Nothing was created there: creating a folder needs more rights than reading.
            return;
        }
    }

    private Journal made(int slot) throws IOException {
        Optional<Journal> journal = Optional.empty();
        while (journal.isEmpty()) {
            Path made = own.resolve(slot + "-" + HexFormat.of().toHexDigits(RANDOM.nextLong()));
            try {
                create(made, DurableFiles::syncFolder);
                journal = openUnlessDeleted(made);
            } catch (NoSuchFileException e) {
                LOG.debug("another task has adopted and deleted {} just now", made, e);
            }
        }
        return journal.get();
    }

    /**
     * Opens the journals of this owner that no task has open, one after another. One that cannot be opened is logged
     * and skipped.
     *
     * @param taker receives and owns each journal; one at which it throws is closed, and no further one is opened
     */
    public void adopt(Consumer<Journal> taker) {
        for (Path folder : foldersOf(own)) {
            if (!isJournal(folder)) {
                continue;
            }
            try {
                openUnlessDeleted(folder).ifPresent(journal -> give(journal, taker));
            } catch (UncheckedIOException e) {
                LOG.warn("an unused journal cannot be taken over", e);
            }
        }
    }

    private Optional<Journal> openUnlessDeleted(Path folder) {
        try {
            return Journal.open(folder, settings);
        } catch (UncheckedIOException e) {
            if (Files.notExists(folder)) { // since it was listed
                return Optional.empty();
            }
            throw e;
        }
    }

    private static boolean isJournal(Path folder) {
        return NAME.matcher(folder.getFileName().toString()).matches();
    }

    private static void give(Journal journal, Consumer<Journal> taker) {
        try {
            taker.accept(journal);
        } catch (RuntimeException | Error e) {
            journal.close();
            throw e;
        }
    }

    /** The journals of any owner that no task has open and that hold a segment. */
    public List<Orphan> orphans() {
        List<Orphan> orphans = new ArrayList<>();
        for (Path owner : foldersOf(root)) {
            for (Path folder :
                    foldersOf(owner).stream().filter(JournalFolders::isJournal).toList()) {
                try {
                    long bytes = segmentBytes(folder);
                    if (bytes > 0 && !JournalLock.isHeld(folder)) {
                        orphans.add(new Orphan(owner.getFileName().toString(), folder, bytes));
                    }
                } catch (IOException e) {
                    LOG.debug("{} vanished or cannot be read", folder, e);
                }
            }
        }
        return orphans;
    }

    private static long segmentBytes(Path folder) throws IOException {
        long bytes = 0;
        try (Stream<Path> files = Files.list(folder)) {
            for (Path file : files.toList()) {
                if (SegmentFormat.baseOf(file.getFileName().toString()).isPresent()) {
                    bytes += Files.size(file);
                }
            }
        }
        return bytes;
    }

    private static List<Path> foldersOf(Path folder) {
        try (Stream<Path> found = Files.list(folder)) {
            return found.filter(Files::isDirectory).sorted().toList();
        } catch (NoSuchFileException e) {
            return List.of();
        } catch (IOException e) {
            throw new UncheckedIOException("cannot list " + folder, e);
        }
    }

    /** Renames a folder so that it is no longer a journal's; returns the new name. */
    static Path markDeleted(Path folder) throws IOException {
        return Files.move(folder, folder.resolveSibling("deleted-" + folder.getFileName()));
    }

    static void delete(Path folder) throws IOException {
        try (Stream<Path> found = Files.walk(folder)) {
            for (Path path : found.sorted(Comparator.reverseOrder()).toList()) {
                Files.delete(path);
            }
        }
    }

    /** A name of a folder, different for different owners: bytes other than letters, digits, - and _ as %XX. */
    public static String folderName(String owner) {
        StringBuilder name = new StringBuilder();
        for (byte part : owner.getBytes(StandardCharsets.UTF_8)) {
            boolean plain = part > 0 && (Character.isLetterOrDigit(part) || part == '-' || part == '_');
            name.append(
                    plain
                            ? String.valueOf((char) part)
                            : "%" + HexFormat.of().withUpperCase().toHexDigits(part));
        }
        return name.toString();
    }
}
