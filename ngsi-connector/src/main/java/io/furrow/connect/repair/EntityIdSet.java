package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.stream.Stream;

import io.furrow.connect.repair.EntityIdFile.Change;
import io.furrow.connect.repair.EntityIdFile.Change.Kind;

/**
 * Stores the entities of one subscription that are on the topic and not deleted, so that deletions can be detected, and
 * the entities that have to be read again. Survives a restart in a {@link EntityIdFile}. Uses a bounded part of the heap:
 * with more entities all are dropped, because a part of them would not reveal deletions. Thread-safe.
 */
final class EntityIdSet implements AutoCloseable {
    /** Per entity besides its identity: the node of the set and a text. */
    private static final int ENTRY_BYTES = 104;
    /** To read more entities one by one takes longer than to read all. */
    static final int MAX_STALE = 10_000;

    private final long maxBytes;
    private final Set<String> identities = new HashSet<>();
    private final Set<String> stale = new HashSet<>();
    private EntityIdFile file;
    private long bytes;
    private boolean tooMany;
    /** Whether the entities did not fit and now may: nothing is known until the next listing. */
    private boolean isIncomplete;

    private EntityIdSet(long maxBytes) {
        this.maxBytes = maxBytes;
    }

    /** @param maxBytes of heap */
    static EntityIdSet open(Path path, long maxBytes) throws IOException {
        EntityIdSet known = new EntityIdSet(maxBytes);
        EntityIdFile.read(path, known::apply);
        known.file = EntityIdFile.write(path, known.changes());
        return known;
    }

    private void apply(Change change) {
        switch (change.kind()) {
            case ADDED -> keep(change.identity());
            case REMOVED -> drop(change.identity());
            case STALE -> stale.add(change.identity());
            case SETTLED -> stale.clear();
            case TOO_MANY -> {
                giveUp();
                tooMany = change.isTooManyFor(maxBytes);
                isIncomplete = !tooMany;
            }
        }
    }

    /** The minimal lines for the current state; the identities are those of this moment. */
    private Iterable<Change> changes() {
        Set<String> now = new HashSet<>(identities);
        List<Change> others = new ArrayList<>();
        stale.forEach(identity -> others.add(new Change(Kind.STALE, identity)));
        if (tooMany) {
            others.add(Change.tooMany(maxBytes));
        }
        return () -> Stream.concat(now.stream().map(identity -> new Change(Kind.ADDED, identity)), others.stream())
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

    /** At two bytes per character. */
    private static long bytesOf(String identity) {
        return ENTRY_BYTES + 2L * identity.length();
    }

    synchronized void add(String identity) throws IOException {
        if (keep(identity)) {
            file.append(tooMany ? Change.tooMany(maxBytes) : new Change(Kind.ADDED, identity));
        }
    }

    synchronized void remove(String identity) throws IOException {
        if (drop(identity)) {
            file.append(new Change(Kind.REMOVED, identity));
        }
    }

    /**
     * Marks an entity to be read again; durable across restarts.
     *
     * @return false if {@link #MAX_STALE} others are marked: then all entities have to be read again
     */
    synchronized boolean markStale(String identity) throws IOException {
        if (stale.contains(identity)) {
            return true;
        }
        if (stale.size() >= MAX_STALE) {
            return false;
        }
        stale.add(identity);
        file.append(new Change(Kind.STALE, identity));
        file.flush();
        return true;
    }

    synchronized boolean isStale(String identity) {
        return stale.contains(identity);
    }

    /** The entities that are marked and not settled. */
    synchronized Set<String> stale() {
        return new HashSet<>(stale);
    }

    /** Unmarks entities that were read again, unless others were marked meanwhile. */
    synchronized void settle(Set<String> these) throws IOException {
        if (!stale.isEmpty() && stale.equals(these)) {
            stale.clear();
            file.append(Change.SETTLED);
        }
    }

    /** Makes the changes durable, and compacts the file if most of it is obsolete. One thread at a time. */
    void flush() throws IOException {
        Iterable<Change> now;
        synchronized (this) {
            file.flush();
        }
        file.sync(); // without the lock, for which notifications would wait
        synchronized (this) {
            if (!file.isWasteful(bytes)) {
                return;
            }
            now = changes();
            file.beginRewrite();
        }
        try {
            file.writeAside(now);
            synchronized (this) {
                file.endRewrite();
            }
        } finally {
            synchronized (this) {
                file.abandonRewrite();
            }
        }
    }

    /** Whether there are more entities than fit. */
    synchronized boolean isOverfull() {
        return tooMany;
    }

    /** Whether entities that it lacks may be on the topic, because the bound was raised since they did not fit. */
    synchronized boolean isIncomplete() {
        return isIncomplete;
    }

    /** All entities of the context broker were added. */
    synchronized void completed() {
        isIncomplete = false;
    }

    synchronized int size() {
        return identities.size();
    }

    synchronized boolean contains(String identity) {
        return identities.contains(identity);
    }

    /** A copy of the current identities. */
    synchronized Set<String> copy() {
        return new HashSet<>(identities);
    }

    @Override
    public synchronized void close() throws IOException {
        file.close();
    }
}
