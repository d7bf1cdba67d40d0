package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.stream.Stream;

/**
 * The entities of one subscription that are on the topic and were not deleted since, so that one that is gone from the context
 * broker can be told, and those that have to be read again. Outlives a restart in a {@link KnownFile}. Takes a bounded part of the heap: of more entities none is
 * known any more, because a part of them would not show which are gone. Any thread.
 */
final class KnownEntities implements AutoCloseable {
    /** Of an entity besides its identity: the node of the set, a text. */
    private static final int ENTRY_BYTES = 104;

    private final long maxBytes;
    private final Set<String> identities = new HashSet<>();
    private final Set<String> stale = new HashSet<>();
    private KnownFile file;
    private long bytes;
    private boolean tooMany;

    private KnownEntities(long maxBytes) {
        this.maxBytes = maxBytes;
    }

    /** @param maxBytes of heap */
    static KnownEntities open(Path path, long maxBytes) throws IOException {
        KnownEntities known = new KnownEntities(maxBytes);
        KnownFile.read(path, known::apply);
        known.file = KnownFile.write(path, known.changes());
        return known;
    }

    private void apply(KnownFile.Change change) {
        switch (change.kind()) {
            case ADDED -> keep(change.identity());
            case REMOVED -> drop(change.identity());
            case STALE -> stale.add(change.identity());
            case SETTLED -> stale.clear();
            case TOO_MANY -> giveUp();
        }
    }

    /** As few lines as say the same; the identities are those of now. */
    private Iterable<KnownFile.Change> changes() {
        Set<String> now = new HashSet<>(identities);
        List<KnownFile.Change> others = new ArrayList<>();
        stale.forEach(identity -> others.add(KnownFile.Change.stale(identity)));
        if (tooMany) {
            others.add(KnownFile.Change.TOO_MANY);
        }
        return () -> Stream.concat(now.stream().map(KnownFile.Change::added), others.stream())
                .iterator();
    }

    private boolean keep(String identity) {
        if (tooMany || !identities.add(identity)) {
            return false;
        }
        bytes += bytesOf(identity);
        if (bytes > maxBytes) {
            giveUp();
        }
        return true;
    }

    private boolean drop(String identity) {
        boolean was = identities.remove(identity);
        bytes -= was ? bytesOf(identity) : 0;
        return was;
    }

    private void giveUp() {
        tooMany = true;
        identities.clear();
        bytes = 0;
    }

    /** At two bytes per sign. */
    private static long bytesOf(String identity) {
        return ENTRY_BYTES + 2L * identity.length();
    }

    synchronized void add(String identity) throws IOException {
        if (keep(identity)) {
            file.append(tooMany ? KnownFile.Change.TOO_MANY : KnownFile.Change.added(identity));
        }
    }

    synchronized void remove(String identity) throws IOException {
        if (drop(identity)) {
            file.append(KnownFile.Change.removed(identity));
        }
    }

    /** An entity has to be read again; this outlives the process. */
    synchronized void markStale(String identity) throws IOException {
        if (stale.add(identity)) {
            file.append(KnownFile.Change.stale(identity));
            file.flush();
        }
    }

    /** Those that were marked and not settled. */
    synchronized Set<String> stale() {
        return new HashSet<>(stale);
    }

    /** All these were read again, unless others were marked meanwhile. */
    synchronized void settle(Set<String> these) throws IOException {
        if (!stale.isEmpty() && stale.equals(these)) {
            stale.clear();
            file.append(KnownFile.Change.SETTLED);
        }
    }

    /** Hands what was noted to the operating system, and writes the file anew where most of it is of no use. */
    void flush() throws IOException {
        Iterable<KnownFile.Change> now;
        synchronized (this) {
            file.flush();
            if (!file.isWasteful(bytes)) {
                return;
            }
            now = changes();
            file.beginRewrite();
        }
        file.writeAside(now);
        synchronized (this) {
            file.endRewrite();
        }
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
        file.close();
    }
}
