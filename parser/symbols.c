/* Interned words with their bindings ("shallow binding": a stack of symbols for each word, a list of symbols for each
 * scope), and the spelling distance for "did you mean". */
#include "parser/symbols.h"

#include <stddef.h>
#include <string.h>

enum { FIRST_BUCKETS = 1024, TEXT_BLOCK = 1 << 16 };

void symbols_init(Symbols *s, Arena *a)
{
    *s = (Symbols){ .arena = a, .n_buckets = FIRST_BUCKETS, .n_scopes = 1 };
    s->buckets = arena_zalloc(a, s->n_buckets, sizeof *s->buckets);
}

/* ---- words ---- */

static uint32_t hash_text(const char *text, size_t length)   /* FNV-1a */
{
    uint32_t h = 2166136261u;
    for (size_t i = 0; i < length; i++) h = (h ^ (unsigned char)text[i]) * 16777619u;
    return h;
}

static void grow_buckets(Symbols *s)
{
    size_t n = s->n_buckets * 2;
    Word **wider = arena_zalloc(s->arena, n, sizeof *wider);
    for (size_t i = 0; i < s->n_buckets; i++) {
        for (Word *w = s->buckets[i], *chain; w; w = chain) {
            chain = w->chain;
            w->chain = wider[w->hash & (n - 1)];
            wider[w->hash & (n - 1)] = w;
        }
    }
    s->buckets = wider, s->n_buckets = n;
}

Word *symbols_intern(Symbols *s, const char *text, size_t length)
{
    uint32_t hash = hash_text(text, length);
    for (Word *w = s->buckets[hash & (s->n_buckets - 1)]; w; w = w->chain) {
        if (w->hash == hash && w->length == length && memcmp(w->text, text, length) == 0) return w;
    }
    if (s->n_words++ > s->n_buckets) grow_buckets(s);
    Word *w = arena_zalloc(s->arena, sizeof *w + length + 1, 1);
    w->hash = hash, w->length = (uint32_t)length;
    memcpy(w->text, text, length);
    Word **bucket = &s->buckets[hash & (s->n_buckets - 1)];
    w->chain = *bucket;
    return *bucket = w;
}

char *symbols_text(Symbols *s, size_t n)
{
    if (n >= SYMBOLS_MAX_TEXT - s->text_total) return NULL;
    s->text_total += n + 1;
    if (n + 1 > TEXT_BLOCK / 4) return arena_alloc(s->arena, n + 1, 1);
    if (n + 1 > s->text_left) {
        s->text = arena_alloc(s->arena, TEXT_BLOCK, 1);
        s->text_left = TEXT_BLOCK;
    }
    char *text = s->text;
    s->text += n + 1, s->text_left -= n + 1;
    return text;
}

static char escaped(char c)
{
    static const char names[] = "abfnrtv", values[] = "\a\b\f\n\r\t\v";
    const char *at = c ? strchr(names, c) : NULL;
    return at ? values[at - names] : c;
}

const char *symbols_unescape(Symbols *s, const char *text, size_t n)
{
    ArenaMark mark = arena_mark(s->arena);
    char *plain = arena_alloc(s->arena, n + 1, 1);
    size_t length = 0;
    for (size_t i = 0; i < n; i++) {
        bool is_escape = text[i] == '\\' && i + 1 < n;
        plain[length++] = is_escape ? escaped(text[++i]) : text[i];
    }
    /* Interned from the heap's copy: the word must not lie above the mark. */
    char local[256];
    if (length > sizeof local) return symbols_intern(s, plain, length)->text;
    memcpy(local, plain, length);
    arena_reset(s->arena, mark);
    return symbols_intern(s, local, length)->text;
}

/* ---- bindings ---- */

static Symbol *bind(Symbols *s, Word *w, int scope)
{
    Symbol *symbol = s->unused;
    if (symbol) s->unused = symbol->next;
    else symbol = ARENA_NEW(s->arena, Symbol);
    *symbol = (Symbol){ .word = w, .hidden = w->symbol, .scope = scope, .next = s->scopes[scope] };
    symbol->slot = &symbol->value;
    if (symbol->next) symbol->next->previous = symbol;
    s->scopes[scope] = symbol;
    return w->symbol = symbol;
}

void symbols_declare(Symbols *s, Word *w, Value v)
{
    if (!w->symbol) bind(s, w, 0);
    *w->symbol->slot = v;
}

static Symbol *local_binding(Symbols *s, Word *w)
{
    int scope = s->n_scopes - 1;
    return w->symbol && w->symbol->scope == scope ? w->symbol : bind(s, w, scope);
}

void symbols_local(Symbols *s, Word *w, Value v)
{
    *local_binding(s, w)->slot = v;
}

void symbols_refer(Symbols *s, Word *w, Value *slot)
{
    local_binding(s, w)->slot = slot;
}

void symbols_remove(Symbols *s, Word *w)
{
    Symbol *symbol = w->symbol;
    if (!symbol) return;
    w->symbol = symbol->hidden;
    if (symbol->next) symbol->next->previous = symbol->previous;
    if (symbol->previous) symbol->previous->next = symbol->next;
    else s->scopes[symbol->scope] = symbol->next;
    /* Not reused: a parameter may still refer to its value. */
}

bool symbols_enter(Symbols *s)
{
    if (s->n_scopes == SYMBOLS_MAX_SCOPES) return false;
    s->scopes[s->n_scopes++] = NULL;
    return true;
}

void symbols_leave(Symbols *s)
{
    Symbol *symbol = s->scopes[--s->n_scopes];
    while (symbol) {
        Symbol *next = symbol->next;
        symbol->word->symbol = symbol->hidden;
        symbol->next = s->unused;
        s->unused = symbol;
        symbol = next;
    }
}

/* ---- did you mean ---- */

enum { NEAR_MAX = 2, NEAR_LENGTH = 64 };

static int min3(int a, int b, int c) { return a < b ? (a < c ? a : c) : (b < c ? b : c); }
static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c | 32) : c; }

/* The number of letters to insert, leave out, replace or exchange with their neighbour; case counts nothing. */
static int spelling_distance(const char *a, size_t n, const char *b, size_t m)
{
    int rows[3][NEAR_LENGTH + 1];
    int *before = rows[0], *last = rows[1], *row = rows[2];
    for (size_t j = 0; j <= m; j++) last[j] = (int)j;
    for (size_t i = 1; i <= n; i++) {
        row[0] = (int)i;
        for (size_t j = 1; j <= m; j++) {
            bool same = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = min3(last[j] + 1, row[j - 1] + 1, last[j - 1] + !same);
            bool exchanged = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
            if (exchanged && before[j - 2] + 1 < row[j]) row[j] = before[j - 2] + 1;
        }
        int *free_row = before;
        before = last, last = row, row = free_row;
    }
    return last[m];
}

const char *symbols_nearest(const Symbols *s, const char *text)
{
    size_t n = strlen(text);
    int best = n < 3 ? 0 : n < 5 ? 1 : NEAR_MAX;   /* one letter in a short word, two in a longer one */
    const Word *nearest = NULL;
    if (n > NEAR_LENGTH) return NULL;
    for (size_t i = 0; i < s->n_buckets; i++) {
        for (const Word *w = s->buckets[i]; w; w = w->chain) {
            bool is_known = w->symbol || w->builtin || w->class == WORD_SUPPORTED || w->class == WORD_CONTEXTUAL;
            if (!is_known || w->length + NEAR_MAX < n || w->length > n + NEAR_MAX || w->length > NEAR_LENGTH) continue;
            int d = spelling_distance(text, n, w->text, w->length);
            bool is_better = d < best || (d == best && (!nearest || strcmp(w->text, nearest->text) < 0));
            if (d <= best && is_better) best = d, nearest = w;   /* of equals the first in the alphabet */
        }
    }
    return nearest ? nearest->text : NULL;
}
