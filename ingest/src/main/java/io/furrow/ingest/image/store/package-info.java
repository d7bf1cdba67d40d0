/** Where images are stored: a folder or a file system of Flink. */
package io.furrow.ingest.image.store;
