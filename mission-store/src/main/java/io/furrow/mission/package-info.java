/** Stored missions: the documents and lines of their events, and how both are read page by page. */
package io.furrow.mission;
