/** Images, and archives of missions, on file systems that other machines keep. */
package io.furrow.stores;
